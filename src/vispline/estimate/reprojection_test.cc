/// The transfer W between two instants and two cameras: the columns of the kernel against dual numbers.
#include "vispline/estimate/reprojection.h"

#include <gtest/gtest.h>

#include "vispline/core/se3.h"
#include "vispline/sensors/lens_testing.h"
#include "vispline/sensors/lenses/models.h"

namespace vispline::testing {
namespace {

/// A landmark of camera `reference` seen by camera `measuring` at another instant of one trajectory.
struct View {
  Camera camera;
  Pose T_w_b;
  Vector6d twist_b;  ///< of the body at that instant
  double line = 0.0;
};
struct Transfer {
  View measuring, reference;
  InverseDepthLandmark landmark;
};

Transfer generic_transfer(LensModel model, std::uint64_t seed, double inverse_distance) {
  Draw draw(seed);
  Transfer t;
  const Pose near = SE3::exp<double>(draw.vector<6>(2.0));
  for (View* view : {&t.measuring, &t.reference}) {
    view->camera.T_c_b = SE3::exp<double>(draw.vector<6>(0.3));
    view->T_w_b = near * SE3::exp<double>(draw.vector<6>(0.15));
    view->twist_b = draw.vector<6>(2.0);
    view->line = 240.0 + 200.0 * draw();
  }
  t.measuring.camera.lens = generic_lens(model, seed);
  t.reference.camera.lens = generic_lens(LensModel::kDoubleSphere, seed + 1);
  t.landmark = {Vector3d(0.2 * draw(), 0.2 * draw(), 1.0).normalized(), inverse_distance};
  return t;
}

/// Both poses, both T_c_b, bearing, inverse distance, time offset, line delay, the lens that measures.
constexpr int kColumns = 4 * 6 + 3 + 1 + 1 + 1 + kMaxLensParams;

NamedColumns columns_of(const Transfer& t) {
  const int lens = static_cast<int>(t.measuring.camera.lens.params.size());
  return {Eigen::MatrixXd(2, 1 + kColumns - kMaxLensParams + lens),
          {{"px", 1},
           {"pose_m", 6},
           {"pose_r", 6},
           {"T_cm_b", 6},
           {"T_cr_b", 6},
           {"bearing", 3},
           {"inverse_distance", 1},
           {"time_offset", 1},
           {"line_delay", 1},
           {"lens", lens}}};
}

/// docs/math/camera.md (17), with everything moved by its part of delta; time moves a body along its twist.
template <class T>
Vector2<T> transfer(const Transfer& t, const Eigen::Matrix<T, kColumns, 1>& delta) {
  const auto body = [&](const View& view, int column) {
    const T dt = delta[28] + T(view.line) * delta[29];
    const Vector6<T> along = dt * view.twist_b.cast<T>();
    return view.T_w_b.cast<T>() * SE3::exp<T>(delta.template segment<6>(column)) * SE3::exp<T>(along);
  };
  const auto mount = [&](const View& view, int column) {
    const Pose& T_c_b = view.camera.T_c_b;
    return PoseT<T>{T_c_b.R.cast<T>() * SO3::exp<T>(delta.template segment<3>(column + 3)),
                    T_c_b.p.cast<T>() + delta.template segment<3>(column)};
  };
  const PoseT<T> T_m_r =
      mount(t.measuring, 12) * body(t.measuring, 0).inverse() * body(t.reference, 6) * mount(t.reference, 18).inverse();
  const Vector3<T> bearing = t.landmark.bearing_c.cast<T>() + delta.template segment<3>(24);
  const Vector3<T> point_c = T_m_r.R * bearing + (T(t.landmark.inverse_distance) + delta[27]) * T_m_r.p;
  const Lens& lens = t.measuring.camera.lens;
  const Eigen::Matrix<T, Eigen::Dynamic, 1> params = lens.params.cast<T>() + delta.segment(30, lens.params.size());
  return lenses::with_model(
      lens.model, [&]<class Model>(Model) { return Model::template project<T>(params.data(), point_c).value(); });
}

NamedColumns by_dual(const Transfer& t) {
  using Dual = ceres::Jet<double, kColumns>;
  Eigen::Matrix<Dual, kColumns, 1> delta;
  for (int i = 0; i < kColumns; ++i) delta[i] = Dual(0.0, i);
  const Vector2<Dual> px = transfer<Dual>(t, delta);
  NamedColumns columns = columns_of(t);
  for (int row = 0; row < 2; ++row) {
    columns.values.row(row) << px[row].a, px[row].v.head(columns.values.cols() - 1).transpose();
  }
  return columns;
}

NamedColumns by_hand(const Transfer& t) {
  const View &m = t.measuring, &r = t.reference;
  const AnchoredPoint anchor = linearize_anchor(r.camera, r.T_w_b, t.landmark);
  const Reprojection image = linearize_reprojection(m.camera, m.T_w_b, anchor.point).value();
  const Matrix2x6 d_pose_r = image.d_point * anchor.d_pose;
  const Vector2d d_time_m = image.d_pose * m.twist_b, d_time_r = d_pose_r * r.twist_b;
  NamedColumns columns = columns_of(t);
  columns.values << image.px, image.d_pose, d_pose_r, image.d_T_c_b, image.d_point * anchor.d_T_c_b,
      image.d_point * anchor.d_bearing, image.d_point * anchor.d_inverse_distance, d_time_m + d_time_r,
      m.line * d_time_m + r.line * d_time_r, image.d_lens;
  return columns;
}

class TransferJacobian : public ::testing::TestWithParam<LensModel> {};

TEST_P(TransferJacobian, GenericPointsAndPointsAtInfinity) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const double inverse_distance = seed % 4 == 0 ? 0.0 : 0.05 * static_cast<double>(seed % 7);
    const Transfer t = generic_transfer(GetParam(), seed, inverse_distance);
    const WorstEntry worst = worst_entry(by_hand(t), by_dual(t));
    EXPECT_LE(worst.relative_error, 1e-12) << worst.text << ", seed " << seed;
  }
}

/// The bearing of the reference pixel moves with the lens it was seen through.
TEST_P(TransferJacobian, LensOfTheReferenceView) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Transfer t = generic_transfer(LensModel::kPinholeRadtan, seed, 0.2);
    t.reference.camera.lens = generic_lens(GetParam(), seed);
    const Vector2d px_r = t.reference.camera.lens.project(t.landmark.bearing_c).value();
    const auto at = [&](int param, double step) -> Vector2d {
      Transfer moved = t;
      moved.reference.camera.lens.params[param] += step;
      moved.landmark.bearing_c = moved.reference.camera.lens.unproject(px_r).value();
      return transfer<double>(moved, Eigen::Matrix<double, kColumns, 1>::Zero());
    };
    const LensRay ray = t.reference.camera.lens.linearize_ray(px_r).value();
    const AnchoredPoint anchor = linearize_anchor(t.reference.camera, t.reference.T_w_b, t.landmark);
    const Reprojection image = linearize_reprojection(t.measuring.camera, t.measuring.T_w_b, anchor.point).value();
    for (int i = 0; i < ray.d_params.cols(); ++i) {
      const double h = 1e-3 * std::max(1.0, std::abs(t.reference.camera.lens.params[i]) * 1e-2);
      const auto slope = [&](double step) -> Vector2d { return (at(i, step) - at(i, -step)) / (2.0 * step); };
      const Vector2d expected = (4.0 * slope(0.5 * h) - slope(h)) / 3.0;
      const Vector2d found = image.d_point * anchor.d_bearing * ray.d_params.col(i);
      EXPECT_LE((found - expected).norm(), 1e-7 * expected.norm() + 1e-8);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Models, TransferJacobian, ::testing::ValuesIn(kLensModels), [](const auto& test) {
  std::string name(lens_name(test.param));
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

/// Equation (7) as printed: inverse depth along z, pixels through K and K^-1.
TEST(Transfer, IsEquationSevenOfThePaper) {
  Transfer t = generic_transfer(LensModel::kPinhole, 4, 0.3);
  t.reference.camera.lens = generic_lens(LensModel::kPinhole, 9);
  const auto K = [](const Lens& lens) {
    Matrix3d matrix = Matrix3d::Identity();
    matrix.diagonal().head<2>() = lens.params.head<2>();
    matrix.col(2).head<2>() = lens.params.segment<2>(2);
    return matrix;
  };
  const Vector3d& bearing = t.landmark.bearing_c;
  const Vector3d px_r = K(t.reference.camera.lens) * bearing / bearing.z();
  const double inverse_depth = t.landmark.inverse_distance / bearing.z();
  const Pose T_b_a =
      t.measuring.camera.T_c_b * t.measuring.T_w_b.inverse() * t.reference.T_w_b * t.reference.camera.T_c_b.inverse();
  const Vector3d P =
      K(t.measuring.camera.lens) * (T_b_a.R * (K(t.reference.camera.lens).inverse() * px_r) + inverse_depth * T_b_a.p);
  EXPECT_LE((by_hand(t).values.col(0) - P.head<2>() / P.z()).norm(), 1e-10);
}

}  // namespace
}  // namespace vispline::testing

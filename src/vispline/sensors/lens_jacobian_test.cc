/// Every lens: linearize() against dual numbers, dual numbers against differences.
#include <gtest/gtest.h>

#include "vispline/sensors/lens_testing.h"
#include "vispline/sensors/lenses/models.h"

namespace vispline::testing {
namespace {

class LensJacobian : public ::testing::TestWithParam<LensModel> {};

/// Inputs: point_c, then all parameters.
template <class T>
std::optional<Vector2<T>> project_moved(const Lens& lens, const Vector3d& point_c,
                                        const Eigen::Matrix<T, Eigen::Dynamic, 1>& delta) {
  const Vector3<T> point = point_c.cast<T>() + delta.template head<3>();
  const Eigen::Matrix<T, Eigen::Dynamic, 1> params = lens.params.cast<T>() + delta.tail(lens.params.size());
  return lenses::with_model(lens.model,
                            [&]<class Model>(Model) { return Model::template project<T>(params.data(), point); });
}

NamedColumns named(const Lens& lens) {
  const auto inputs = 3 + lens.params.size();
  NamedColumns columns{Eigen::MatrixXd(2, 1 + inputs), {{"px", 1}, {"point", 3}}};
  for (int i = 0; i < lens.params.size(); ++i) columns.groups.emplace_back(lens_param_name(lens.model, i), 1);
  return columns;
}

NamedColumns by_dual(const Lens& lens, const Vector3d& point_c) {
  using Dual = ceres::Jet<double, 3 + kMaxLensParams>;
  Eigen::Matrix<Dual, Eigen::Dynamic, 1> delta(3 + lens.params.size());
  for (int i = 0; i < delta.size(); ++i) delta[i] = Dual(0.0, i);
  const auto px = project_moved<Dual>(lens, point_c, delta).value();
  NamedColumns columns = named(lens);
  for (int row = 0; row < 2; ++row) columns.values.row(row) << px[row].a, px[row].v.head(delta.size()).transpose();
  return columns;
}

NamedColumns by_hand(const Lens& lens, const Vector3d& point_c) {
  const LensProjection projection = lens.linearize(point_c).value();
  NamedColumns columns = named(lens);
  columns.values << projection.px, projection.d_point, projection.d_params;
  return columns;
}

/// Central differences of second and fourth order together (Richardson), step 1e-3.
NamedColumns by_difference(const Lens& lens, const Vector3d& point_c) {
  NamedColumns columns = named(lens);
  columns.values.col(0) = lens.project(point_c).value();
  for (int i = 0; i < 3 + lens.params.size(); ++i) {
    const auto slope = [&](double step) -> Vector2d {
      Eigen::VectorXd delta = Eigen::VectorXd::Zero(3 + lens.params.size());
      delta[i] = step;
      const Vector2d above = project_moved<double>(lens, point_c, delta).value();
      return (above - project_moved<double>(lens, point_c, -delta).value()) / (2.0 * step);
    };
    columns.values.col(1 + i) = (4.0 * slope(5e-4) - slope(1e-3)) / 3.0;
  }
  return columns;
}

/// Differences of pixels cannot be better than their last digits over the step: hence the 1e-8.
void expect_right_at(const Lens& lens, const Vector3d& point_c) {
  const NamedColumns dual = by_dual(lens, point_c);
  const WorstEntry hand = worst_entry(by_hand(lens, point_c), dual);
  EXPECT_LE(hand.relative_error, 1e-12) << hand.text << " at " << point_c.transpose();
  const Eigen::ArrayXXd error = (by_difference(lens, point_c).values - dual.values).array().abs();
  EXPECT_TRUE((error <= 1e-7 * dual.values.array().abs() + 1e-8).all())
      << error << "\nin differences of\n"
      << dual.values << "\nat " << point_c.transpose();
}

TEST_P(LensJacobian, GenericPoints) {
  int tested = 0;
  for (std::uint64_t seed = 1; tested < 200 && seed < 1000; ++seed) {
    const Lens lens = generic_lens(GetParam(), seed);
    Draw draw(seed + 10000);
    const Vector3d point_c = draw.vector<3>(3.0) + Vector3d(0.0, 0.0, 2.0);
    if (point_c.z() < 0.4 || point_c.head<2>().norm() > 1.3 * point_c.z() || !lens.project(point_c)) continue;
    expect_right_at(lens, point_c);
    ++tested;
  }
  EXPECT_EQ(tested, 200);
}

TEST_P(LensJacobian, OnAndNearTheAxis) {
  for (const double offset : {0.0, 1e-12, 1e-8, 1e-5, 1e-3, 0.1, 0.17677, 0.17678}) {
    expect_right_at(generic_lens(GetParam(), 3), Vector3d(0.6, -0.8, 0.0) * 2.0 * offset + Vector3d(0.0, 0.0, 2.0));
  }
}

TEST_P(LensJacobian, BehindTheImagePlane) {
  const Lens lens = generic_lens(GetParam(), 5);
  const Vector3d point_c(1.9, -0.7, -0.12);
  if (lens.project(point_c)) expect_right_at(lens, point_c);
}

TEST_P(LensJacobian, OfTheRayInvertsThatOfThePixel) {
  const Lens lens = generic_lens(GetParam(), 7);
  const Vector3d point_c(0.5, -0.3, 1.1);
  const LensProjection pixel = lens.linearize(point_c.normalized()).value();
  const LensRay ray = lens.linearize_ray(pixel.px).value();
  EXPECT_LE((ray.bearing_c - point_c.normalized()).norm(), 1e-14);
  EXPECT_LE((pixel.d_point * ray.d_px - lenses::Matrix2d::Identity()).norm(), 1e-12);
  EXPECT_LE((pixel.d_point * ray.d_params + pixel.d_params).norm(), 1e-12 * pixel.d_params.norm());
  EXPECT_LE((ray.bearing_c.transpose() * ray.d_px).norm(), 1e-15);
  for (int i = 0; i < lens.params.size(); ++i) {
    const auto moved = [&](double step) {
      Lens other = lens;
      other.params[i] += step;
      return other.unproject(pixel.px).value();
    };
    const double step = 1e-5 * std::max(1.0, lens.params[i]);
    const Vector3d difference = (moved(step) - moved(-step)) / (2.0 * step);
    EXPECT_LE((difference - ray.d_params.col(i)).norm(), 1e-7 * ray.d_params.col(i).norm() + 1e-12)
        << lens_param_name(lens.model, i);
  }
}

TEST(FovJacobian, SmallParameter) {
  for (const double w : {0.0, 1e-9, 1e-4, 0.0999, 0.1001}) {
    expect_right_at(make_lens(LensModel::kPinholeFov, {230.0, 231.0, 320.0, 240.0, w}), Vector3d(0.7, -0.4, 1.2));
  }
}

INSTANTIATE_TEST_SUITE_P(Models, LensJacobian, ::testing::ValuesIn(kLensModels), [](const auto& test) {
  std::string name(lens_name(test.param));
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace vispline::testing

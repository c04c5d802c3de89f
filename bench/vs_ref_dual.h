/// The reference problem as estimators with automatic differentiation solve it: dual numbers through the whole chain
/// from knots to residual, four derivatives a pass, one residual block a reading, SPARSE_SCHUR. The baseline of
/// vs_ref_bench.cc; structure after Ovren's and Forssen's Kontiki, written anew.
#pragma once

#include <ceres/ceres.h>

#include <memory>

#include "vispline/trajectory/pose_spline.h"
#include "vs_ref_problem.h"

namespace vispline::bench {

inline constexpr int kJets = 4;  // derivatives of a pass

/// A stretch of four knots among the parameter blocks of a residual, and the place in it.
struct Stretch {
  std::array<std::size_t, 4> block{0, 1, 2, 3};
  double u = 0.0, spacing_s = 0.1;

  template <class T>
  std::array<PoseT<T>, 4> knots(T const* const* blocks) const {
    std::array<PoseT<T>, 4> X;
    for (std::size_t k = 0; k < 4; ++k) {
      const T* x = blocks[block[k]];
      X[k] = {Eigen::Map<const Eigen::Quaternion<T>>(x).toRotationMatrix(), Eigen::Map<const Vector3<T>>(x + 4)};
    }
    return X;
  }
  template <class T>
  static std::array<Vector6<T>, 3> increments(const std::array<PoseT<T>, 4>& X) {
    std::array<Vector6<T>, 3> d;
    for (std::size_t j = 0; j < 3; ++j) d[j] = SE3::log<T>(SE3::compose<T>(SE3::inverse<T>(X[j]), X[j + 1]));
    return d;
  }
  template <class T>
  PoseT<T> pose(T const* const* blocks) const {
    const auto X = knots<T>(blocks);
    return cumulative_element<SE3, 4, T>(X[0], increments<T>(X), CumulativeBasis<4, T>(T(u), spacing_s));
  }
  template <class T>
  BodyStateT<T> state(T const* const* blocks) const {
    const auto X = knots<T>(blocks);
    const CumulativeBasis<4, T> basis(T(u), spacing_s);
    const CumulativePoint<SE3, 4, T> point(X[0], increments<T>(X), basis);
    return BodyFrame<SE3>::state<T>(point.X, point.V(), point.dV());
  }
};

struct DualGyro {
  Stretch at;
  Vector3d measured;
  template <class T>
  bool operator()(T const* const* blocks, T* r) const {
    Eigen::Map<Vector3<T>>{r} = (at.state<T>(blocks).omega_b - measured.cast<T>()) / T(kGyroSigma);
    return true;
  }
};

struct DualAccel {
  Stretch at;
  Vector3d measured;
  template <class T>
  bool operator()(T const* const* blocks, T* r) const {
    const BodyStateT<T> state = at.state<T>(blocks);
    const Vector3<T> force_b = state.R_w_b.transpose() * (state.a_w - kGravity_w.cast<T>());
    Eigen::Map<Vector3<T>>{r} = (force_b - measured.cast<T>()) / T(kAccelSigma);
    return true;
  }
};

/// The inverse distance is the last block.
struct DualSighting {
  Stretch reference, here;
  const Camera* camera;
  Vector3d bearing_c;
  Vector2d px;
  std::size_t landmark;
  template <class T>
  bool operator()(T const* const* blocks, T* r) const {
    const PoseT<T> T_b_c = camera->T_c_b.inverse().cast<T>(), T_c_b = camera->T_c_b.cast<T>();
    const PoseT<T> T_w_r = reference.pose<T>(blocks) * T_b_c, T_c_w = T_c_b * here.pose<T>(blocks).inverse();
    const T& rho = blocks[landmark][0];
    const Vector3<T> y_w = T_w_r.R * bearing_c.cast<T>() + rho * T_w_r.p;
    const Vector3<T> y_c = T_c_w.R * y_w + rho * T_c_w.p;
    const auto& k = camera->lens.params;
    r[0] = (k(0) * y_c.x() / y_c.z() + k(2) - px.x()) / kPixelSigma;
    r[1] = (k(1) * y_c.y() / y_c.z() + k(3) - px.y()) / kPixelSigma;
    return true;
  }
};

class DualBaseline {
 public:
  DualBaseline(const VsRef& data, const State& start) : curve_(*start.curve), camera_(data.rig.cameras[0]) {
    knots_.reserve(curve_.knots());  // Ceres keeps addresses
    for (const Pose& knot : curve_.knot_poses()) {
      auto& x = knots_.emplace_back();
      Eigen::Map<Eigen::Quaterniond>(x.data()) = knot.quaternion();
      Eigen::Map<Vector3d>(x.data() + 4) = knot.p;
      problem_.AddParameterBlock(x.data(), 7, new Manifold);
    }
    for (const InverseDepthLandmark& landmark : start.landmarks) rho_.push_back(landmark.inverse_distance);
    for (std::size_t i = 0; i < data.imu.size(); ++i) add_imu(data.imu.time[i], data.imu.value[i]);
    for (const Track& track : data.tracks) {
      for (std::size_t i = 1; i < track.sightings.size(); ++i) add_sighting(track, track.sightings[i], start);
    }
  }

  ceres::Solver::Summary solve() {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::SPARSE_SCHUR;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    return summary;
  }

  std::unique_ptr<Curve> curve() const {
    std::size_t k = 0;
    return make_curve({SplineKind::kJoint, 4, curve_.spacing()}, curve_.span(), [&](Time) {
      const double* x = knots_[k++].data();
      return Pose{Eigen::Map<const Eigen::Quaterniond>(x).toRotationMatrix(), Eigen::Map<const Vector3d>(x + 4)};
    });
  }

 private:
  using Manifold = ceres::ProductManifold<ceres::EigenQuaternionManifold, ceres::EuclideanManifold<3>>;

  /// Binds an instant to its knots, which are appended to `blocks` unless they are there already.
  Stretch stretch(const Instant& at, std::vector<double*>& blocks) {
    Stretch stretch;
    const std::size_t first = curve_.first_knot(at);
    const Time begin = curve_.span().begin + static_cast<std::int64_t>(first) * curve_.spacing();
    stretch.spacing_s = to_seconds(curve_.spacing());
    stretch.u = (to_seconds(at.time - begin) + at.extra_s) / stretch.spacing_s;
    for (std::size_t k = 0; k < 4; ++k) {
      double* x = knots_[first + k].data();
      const auto found = std::find(blocks.begin(), blocks.end(), x);
      stretch.block[k] = static_cast<std::size_t>(found - blocks.begin());
      if (found == blocks.end()) blocks.push_back(x);
    }
    return stretch;
  }

  template <class Residual>
  void add(const Residual& residual, int size, ceres::LossFunction* loss, const std::vector<double*>& blocks) {
    auto* cost = new ceres::DynamicAutoDiffCostFunction<Residual, kJets>(new Residual(residual));
    for (const double* block : blocks)
      cost->AddParameterBlock(problem_.HasParameterBlock(block) && problem_.ParameterBlockSize(block) == 7 ? 7 : 1);
    cost->SetNumResiduals(size);
    problem_.AddResidualBlock(cost, loss, blocks);
  }

  void add_imu(Time time, const ImuSample& sample) {
    std::vector<double*> blocks;
    const Stretch at = stretch({time}, blocks);
    add(DualGyro{at, sample.gyro}, 3, nullptr, blocks);
    add(DualAccel{at, sample.accel}, 3, nullptr, blocks);
  }

  void add_sighting(const Track& track, const Sighting& s, const State& start) {
    std::vector<double*> blocks;
    const Sighting& first = track.sightings.front();
    const Stretch reference = stretch({first.stamp, camera_.delay_s(first.px)}, blocks);
    const Stretch here = stretch({s.stamp, camera_.delay_s(s.px)}, blocks);
    const std::size_t landmark = blocks.size();
    blocks.push_back(&rho_[track.landmark]);
    add(DualSighting{reference, here, &camera_, start.landmarks[track.landmark].bearing_c, s.px, landmark}, 2,
        new ceres::HuberLoss(kHuber), blocks);
  }

  const Curve& curve_;
  const Camera& camera_;
  std::vector<std::array<double, 7>> knots_ = {};
  std::vector<double> rho_ = {};
  ceres::Problem problem_;
};

}  // namespace vispline::bench

/// The reference problem as the estimator takes it: all knots and landmarks free, nothing else; a start that is off by
/// 5 cm, 1.7 deg and 20 % of the depths. docs/math/estimate.md, The reference problem.
#pragma once

#include <utility>

#include "vispline/estimate/imu_measurement.h"
#include "vs_ref_data.h"

namespace vispline::bench {

struct VsRefSetup {
  SplineKind kind = SplineKind::kJoint;
  double spacing_s = 0.1;
  LandmarkUnknowns unknowns = LandmarkUnknowns::kPoint;
};

inline void start_landmarks(const VsRef& data, std::mt19937_64& random, State& state) {
  std::normal_distribution<double> normal;
  const Camera& camera = data.rig.cameras[0];
  for (const Track& track : data.tracks) {
    const Sighting& first = track.sightings.front();
    const Pose T_w_b = true_pose(seconds(first.stamp) + camera.delay_s(first.px));
    const Vector3d& point_w = data.points_w[data.point_of_track[track.landmark]];
    const double distance = (camera.T_c_b * (T_w_b.inverse() * point_w)).norm();
    state.landmarks.push_back({*camera.lens.unproject(first.px), std::max(0.3, 1.0 + 0.2 * normal(random)) / distance});
  }
}

/// One batch for each segment of the curve.
inline void add_imu(const VsRef& data, Problem& problem) {
  const ImuSigma sigma{kGyroSigma, kAccelSigma};
  const auto segment = [&](std::size_t i) { return problem.start.curve->first_knot({data.imu.time[i]}); };
  for (std::size_t begin = 0, end = 0; begin < data.imu.size(); begin = end) {
    while (end < data.imu.size() && segment(end) == segment(begin)) ++end;
    problem.measurements.push_back(imu_measurement(
        problem.start, {0, {&data.imu.time[begin], end - begin}, {&data.imu.value[begin], end - begin}, sigma, {}}));
  }
}

inline Problem vs_ref_problem(const VsRef& data, const VsRefSetup& setup) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  const auto vector = [&](double sigma) {
    return Vector3d(Vector3d::NullaryExpr([&](Eigen::Index) { return sigma * normal(random); }));
  };
  Problem problem;
  State& state = problem.start;
  const TimeSpan span{Time{} + from_seconds(0.05), Time{} + from_seconds(0.05 + data.duration_s)};
  state.curve = make_curve({setup.kind, 4, from_seconds(setup.spacing_s)}, span, [&](Time knot) {
    const Vector3d position = vector(0.05), rotation = vector(0.03);
    Pose T_w_b = true_pose(seconds(knot));
    return Pose{T_w_b.R * SO3::exp<double>(rotation), T_w_b.p + position};
  });
  state.rig = data.rig;
  state.g_w = kGravity_w;
  problem.tracks = data.tracks;
  problem.track_model = {setup.unknowns, {kPixelSigma}, {kHuber}};
  problem.parameters = parameters_of(state);
  start_landmarks(data, random, state);
  add_imu(data, problem);
  return problem;
}

}  // namespace vispline::bench

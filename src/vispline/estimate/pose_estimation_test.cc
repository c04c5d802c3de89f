// IMU and poses from outside: clock, lever arm and rotation without a start.
#include "vispline/estimate/pose_estimation.h"

#include <gtest/gtest.h>

#include "vispline/core/random.h"
#include "vispline/estimate/simulated_testing.h"

namespace vispline {
namespace {

using testing::Simulated;

const Pose kT_b_k{SO3::exp<double>(Vector3d(0.4, -2.1, 0.9)), Vector3d(0.06, -0.03, 0.08)};
constexpr double kOffset_s = -0.0372, kPosition_m = 5e-4, kRotation_rad = 1e-3;

Signal<Pose> noisy_poses(const Simulated& data) {
  Signal<Pose> poses = data.poses(kT_b_k, kOffset_s, 100.0, 7.0);
  const RandomStream stream(3, "poses");
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto z = [&](std::uint64_t k) { return stream.normal(6 * i + k); };
    Pose& pose = poses.value[i];
    pose.p += kPosition_m * Vector3d(z(0), z(1), z(2));
    pose.R = pose.R * SO3::exp<double>(Vector3d(kRotation_rad * Vector3d(z(3), z(4), z(5))));
  }
  return poses;
}

PoseEstimationOptions options_of(const CurveShape& shape) {
  PoseEstimationOptions options;
  options.curve = shape;
  options.gravity = testing::kGravity;
  return options;
}

void expect_reference(const Estimation& estimation) {
  const PoseReference& reference = estimation.solution.state.references[0];
  EXPECT_NEAR(reference.time_offset_s, kOffset_s, 3e-4);
  EXPECT_LT(SO3::log<double>(Matrix3d(reference.T_b_k.R.transpose() * kT_b_k.R)).norm(), 2e-3);
  EXPECT_LT((reference.T_b_k.p - kT_b_k.p).norm(), 2e-3);
}

TEST(PoseEstimation, FindsClockLeverArmAndRotation) {
  const Simulated data({.duration_s = 7.0});
  for (const CurveShape& shape :
       {CurveShape{SplineKind::kJoint, 4, from_seconds(0.04)}, CurveShape{SplineKind::kSplit, 5, from_seconds(0.05)}}) {
    const Signal<Pose> poses = noisy_poses(data);
    const Estimation estimation = estimate_with_poses(data.truth, data.imu(), poses, options_of(shape));
    expect_reference(estimation);
    testing::expect_truth(estimation, {data.truth.imus, {}}, 4.0);
    const auto measured = estimation.problem.measurements.back()->sensors();
    EXPECT_FALSE(measured.empty());
  }
}

TEST(PoseEstimation, FindsTheSizesOfTheNoise) {
  const Simulated data({.duration_s = 7.0, .noise = 2.0});
  const Signal<Pose> poses = noisy_poses(data);
  const Estimation estimation =
      estimate_with_poses(data.truth, data.imu(), poses, options_of({SplineKind::kJoint, 4, from_seconds(0.04)}));
  const CalibrationResult result = assess(estimation.problem, estimation.solution, {.check_gradient = false});
  const std::map<std::string, double> expected{{"imu0.gyroscope", 6e-3},
                                               {"imu0.accelerometer", 4e-2},
                                               {"reference0.position", kPosition_m},
                                               {"reference0.rotation", kRotation_rad}};
  for (const SensorResiduals& r : result.residuals) EXPECT_NEAR(r.sigma / expected.at(r.sensor), 1.0, 0.15) << r.sensor;
}

TEST(PoseEstimation, FollowsABiasThatWalks) {
  const Simulated data({.duration_s = 7.0});
  const Signal<Pose> poses = noisy_poses(data);
  ImuSignal imu = data.imu();
  const auto drift = [&](double t) {
    Vector6d bias;
    bias << 0.03 * t / 7.0, 0.01 * std::sin(t), -0.01, 0.3 * std::sin(0.7 * t), 0.2 * t / 7.0, 0.1;
    return bias;
  };
  for (std::size_t i = 0; i < imu.size(); ++i) {
    const Vector6d bias = drift(to_seconds(imu.time[i] - imu.time[0]));
    imu.value[i].gyro += bias.head<3>();
    imu.value[i].accel += bias.tail<3>();
  }
  Rig rig = data.truth;
  PoseEstimationOptions options = options_of({SplineKind::kJoint, 4, from_seconds(0.04)});
  options.bias_walk = from_seconds(0.5);
  EXPECT_THROW(estimate_with_poses(rig, imu, poses, options), Error);
  rig.imus[0].noise.gyro.walk = 0.01;
  rig.imus[0].noise.accel.walk = 0.15;
  const Estimation estimation = estimate_with_poses(rig, imu, poses, options);
  expect_reference(estimation);
  const State& state = estimation.solution.state;
  const auto error_at = [&](double t) {
    Vector6d bias, expected;
    bias << state.rig.imus[0].gyroscope.bias, state.rig.imus[0].accelerometer.bias;
    expected << data.truth.imus[0].gyroscope.bias, data.truth.imus[0].accelerometer.bias;
    return Vector6d(bias + state.bias_walks[0].at({imu.time[0] + from_seconds(t)}) - expected - drift(t));
  };
  for (const double t : {0.5, 2.0, 3.5, 5.0, 6.5}) {
    EXPECT_LT(error_at(t).head<3>().norm(), 3e-3) << t;
    // A tilt of gravity by 6 mrad and a bias of 0.06 m/s^2 look alike in 7 s; how it walks does not.
    EXPECT_LT(error_at(t).tail<3>().norm(), 0.1) << t;
    EXPECT_LT((error_at(t) - error_at(3.5)).tail<3>().norm(), 0.05) << t;
  }
}

TEST(PoseEstimation, SameBytesForAnyThreads) {
  const Simulated data({.duration_s = 6.0});
  const Signal<Pose> poses = noisy_poses(data);
  PoseEstimationOptions options = options_of({SplineKind::kSplit, 6, from_seconds(0.06)});
  const Estimation one = estimate_with_poses(data.truth, data.imu(), poses, options);
  options.solve.threads = 2;
  const Estimation two = estimate_with_poses(data.truth, data.imu(), poses, options);
  EXPECT_EQ(one.solution.cost, two.solution.cost);
  EXPECT_EQ(one.solution.state.references[0].time_offset_s, two.solution.state.references[0].time_offset_s);
  EXPECT_EQ(one.solution.covariance, two.solution.covariance);
}

}  // namespace
}  // namespace vispline

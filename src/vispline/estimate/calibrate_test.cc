// Camera-IMU calibration on simulated corners, from a start that knows the lens only.
#include "vispline/estimate/calibrate.h"

#include <gtest/gtest.h>

#include "vispline/estimate/simulated_testing.h"

namespace vispline {
namespace {

using testing::Simulated;

CalibrateOptions options_of(const CurveShape& shape) {
  CalibrateOptions options;
  options.curve = shape;
  options.gravity = testing::kGravity;
  options.treatments = {{"imu0.gyroscope.scale", {Role::kFixed}},
                        {"imu0.gyroscope.misalignment", {Role::kFixed}},
                        {"imu0.accelerometer.scale", {Role::kFixed}},
                        {"imu0.accelerometer.misalignment", {Role::kFixed}}};
  return options;
}

TEST(Calibrate, NoisyDataWithinFourSigmas) {
  const Simulated data;
  const Estimation estimation =
      calibrate(data.start(), data.recording, data.target, options_of({SplineKind::kJoint, 4, from_seconds(0.04)}));
  testing::expect_truth(estimation, data.truth, 4.0);
  for (const Stage& stage : estimation.stages) EXPECT_TRUE(stage.passed) << stage.name << " " << stage.value;
  EXPECT_LT((estimation.solution.state.g_w - Vector3d(0.0, 0.0, -testing::kGravity)).norm(), 0.02);
}

/// The dance is no spline: what remains without noise is the spline's error, which falls with its order.
TEST(Calibrate, WithoutNoiseOnlyTheSplineIsLeft) {
  const Simulated data({.noise = 1e-6});
  CalibrateOptions options = options_of({SplineKind::kSplit, 6, from_seconds(0.04)});
  options.trust_noise = true;
  const Estimation estimation = calibrate(data.start(), data.recording, data.target, options);
  const State& state = estimation.solution.state;
  const Camera &camera = state.rig.cameras[0], &truth = data.truth.cameras[0];
  EXPECT_LT((camera.T_c_b.p - truth.T_c_b.p).norm(), 2e-6);
  EXPECT_LT(SO3::log<double>(Matrix3d(camera.T_c_b.R.transpose() * truth.T_c_b.R)).norm(), 1e-6);
  EXPECT_NEAR(camera.time_offset_s, truth.time_offset_s, 1e-7);
  EXPECT_NEAR(camera.shutter.line_delay_s, truth.shutter.line_delay_s, 1e-9);
  EXPECT_LT((state.rig.imus[0].gyroscope.bias - data.truth.imus[0].gyroscope.bias).norm(), 1e-6);
  EXPECT_LT((state.rig.imus[0].accelerometer.bias - data.truth.imus[0].accelerometer.bias).norm(), 2e-5);
  EXPECT_LT(estimation.solution.cost, 3e-2);
}

TEST(Calibrate, SameBytesForAnyThreads) {
  const Simulated data({.duration_s = 4.0});
  CalibrateOptions options = options_of({SplineKind::kJoint, 5, from_seconds(0.06)});
  const Estimation one = calibrate(data.start(), data.recording, data.target, options);
  options.solve.threads = 2;
  const Estimation two = calibrate(data.start(), data.recording, data.target, options);
  EXPECT_EQ(one.solution.cost, two.solution.cost);
  EXPECT_EQ(one.solution.covariance, two.solution.covariance);
  EXPECT_EQ(one.solution.state.rig.cameras[0].T_c_b.R, two.solution.state.rig.cameras[0].T_c_b.R);
  EXPECT_EQ(one.solution.state.curve->knot_poses().back().R, two.solution.state.curve->knot_poses().back().R);
}

TEST(Calibrate, AnotherTargetIsNamed) {
  const Simulated data({.duration_s = 2.0});
  try {
    calibrate(data.start(), data.recording, {{1000, Vector3d::Zero()}}, options_of({}));
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::kUnfit);
    EXPECT_EQ(error.diagnostic().code, "E-TARGET") << error.what();
  }
}

}  // namespace
}  // namespace vispline

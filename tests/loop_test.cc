// simulate and its inverses: what one folder makes, another must find again.
#include <gtest/gtest.h>

#include <cmath>

#include "vispline/core/so3.h"
#include "vispline/integrate/dead_reckon.h"
#include "vispline/io/io_testing.h"
#include "vispline/io/write.h"
#include "vispline/results/dead_reckoning_error.h"
#include "vispline/results/imu_comparison.h"
#include "vispline/simulate/imu_simulation.h"
#include "vispline/trajectory/analytic.h"
#include "vispline/trajectory/fit.h"

namespace vispline {
namespace {

Trajectory motion(const std::string& name, double duration_s, double start_s = 0.0) {
  return *analytic_trajectory(name, Time{} + from_seconds(start_s), from_seconds(duration_s));
}

/// Both ends of the curve included.
Stamps stamps_of(const Trajectory& trajectory, double rate_hz) {
  const TimeSpan span = trajectory.span();
  return Stamps({span.begin, rate_hz}, span.end - span.begin + Duration(1));
}

Signal<Pose> poses_of(const Trajectory& trajectory, double rate_hz) {
  const Stamps stamps = stamps_of(trajectory, rate_hz);
  Signal<Pose> signal;
  for (std::size_t i = 0; i < stamps.size(); ++i) signal.push_back(stamps[i], trajectory.at(stamps[i])->T_w_b());
  return signal;
}

struct StateError {
  double p_rms_m = 0, a_rms = 0, v_max = 0, angle_max = 0, omega_max = 0, p_max_m = 0;
};

/// At stamps that are neither knots nor samples, `margin_s` away from both ends.
StateError state_error(const Trajectory& estimate, const Trajectory& truth, double margin_s) {
  StateError error;
  const TimeSpan span = truth.span();
  int count = 0;
  for (Time t = span.begin + from_seconds(margin_s); t < span.end - from_seconds(margin_s);
       t += from_seconds(0.00317)) {
    const BodyState a = *estimate.at(t), b = *truth.at(t);
    ++count;
    error.p_rms_m += (a.p_w - b.p_w).squaredNorm();
    error.a_rms += (a.a_w - b.a_w).squaredNorm();
    error.p_max_m = std::max(error.p_max_m, (a.p_w - b.p_w).norm());
    error.v_max = std::max(error.v_max, (a.v_w - b.v_w).norm());
    error.angle_max = std::max(error.angle_max, SO3::log<double>(b.R_w_b.transpose() * a.R_w_b).norm());
    error.omega_max = std::max(error.omega_max, (a.omega_b - b.omega_b).norm());
  }
  error.p_rms_m = std::sqrt(error.p_rms_m / count);
  error.a_rms = std::sqrt(error.a_rms / count);
  return error;
}

TEST(Loop, SimulateWriteRead) {
  const ScratchFolder folder;
  ImuSimulation simulation{.seed = 12, .threads = 2};
  simulation.imu.noise = {.gyro = {.white = 0.01, .walk = 1e-4}, .accel = {.white = 0.02, .turn_on_bias = 0.1}};
  const Trajectory trajectory = motion("dance", 7.0, 1.6e9);
  const SimulatedImu made = simulate_imu(trajectory, simulation, stamps_of(trajectory, 333.0));
  write_imu_csv(folder.path("imu.csv"), made.measured);
  const auto read = read_imu(folder.path("imu.csv"));
  EXPECT_TRUE(read.diagnostics.empty());
  ASSERT_EQ(read.value.time, made.measured.time);
  for (std::size_t i = 0; i < read.value.size(); ++i) {
    ASSERT_EQ(read.value.value[i].gyro, made.measured.value[i].gyro) << i;
    ASSERT_EQ(read.value.value[i].accel, made.measured.value[i].accel) << i;
  }
}

TEST(Loop, TrajectoryWriteReadFit) {
  const ScratchFolder folder;
  const Trajectory truth = motion("dance", 12.0, 1.5e9);
  write_trajectory_tum(folder.path("t.tum"), poses_of(truth, 100.0));
  const auto read = read_trajectory(folder.path("t.tum"));
  EXPECT_TRUE(read.diagnostics.empty());
  for (const SplineKind kind : {SplineKind::kJoint, SplineKind::kSplit}) {
    for (const int order : {4, 6}) {
      const TrajectoryFit fit = fit_trajectory(read.value, {.kind = kind, .order = order, .spacing_s = 0.05});
      EXPECT_TRUE(fit.converged);
      const StateError error = state_error(fit.trajectory, truth, 0.25);
      EXPECT_LT(error.p_max_m, 1e-5) << "order " << order;
      EXPECT_LT(error.angle_max, 1e-4);
      EXPECT_LT(error.v_max, 2e-3);
      EXPECT_LT(error.omega_max, 1e-2);
    }
  }
}

TEST(Loop, ChosenKnotsCarryTheDance) {
  const Trajectory truth = motion("dance", 20.0);
  const TrajectoryFit fit = fit_trajectory(poses_of(truth, 200.0));
  ASSERT_TRUE(fit.converged);
  const StateError error = state_error(fit.trajectory, truth, 0.5);
  EXPECT_LT(error.p_max_m, 1e-4) << "spacing " << fit.spacing_s;
  EXPECT_LT(error.angle_max, 1e-3);
  EXPECT_LT(error.omega_max, 5e-2);
}

/// A cubic spline errs as spacing^4 in position and spacing^2 in acceleration.
TEST(Loop, FittedSplineOfTheEllipse) {
  const Trajectory truth = motion("ellipse", 20.0);
  const Signal<Pose> poses = poses_of(truth, 200.0);
  const StateError coarse = state_error(fit_trajectory(poses, {.spacing_s = 0.1}).trajectory, truth, 0.0);
  EXPECT_LT(coarse.p_rms_m, 0.02e-3);
  EXPECT_LT(coarse.a_rms, 30e-3);
  const StateError fine = state_error(fit_trajectory(poses, {.spacing_s = 0.05}).trajectory, truth, 0.5);
  const StateError inner = state_error(fit_trajectory(poses, {.spacing_s = 0.1}).trajectory, truth, 0.5);
  EXPECT_NEAR(std::log2(inner.p_rms_m / fine.p_rms_m), 4.0, 0.3);
  EXPECT_NEAR(std::log2(inner.a_rms / fine.a_rms), 2.0, 0.2);
}

TEST(Loop, SimulateDeadReckonConverges) {
  const Trajectory truth = motion("dance", 10.0);
  struct Rule {
    const char* name;
    int order;
  };
  for (const Rule& rule : {Rule{"euler", 1}, Rule{"midpoint", 2}, Rule{"rk4", 2}, Rule{"rk4_cubic", 4}}) {
    std::vector<double> errors_m;
    for (const double rate_hz : {200.0, 400.0, 800.0}) {
      const ImuSimulation simulation;
      const SimulatedImu imu = simulate_imu(truth, simulation, stamps_of(truth, rate_hz));
      const auto states = dead_reckon(imu.measured, nav_state(imu.body.value[0]), rule.name, simulation.g_w);
      errors_m.push_back(dead_reckoning_error(poses(states), truth).max_error_m);
    }
    EXPECT_NEAR(std::log2(errors_m[0] / errors_m[1]), rule.order, 0.25) << rule.name;
    EXPECT_NEAR(std::log2(errors_m[1] / errors_m[2]), rule.order, 0.25) << rule.name;
  }
}

/// The IMU of a fitted spline and the IMU of the motion it was fitted to.
TEST(Loop, FitSimulateEvaluate) {
  const Trajectory truth = motion("dance", 20.0);
  const TrajectoryFit fit = fit_trajectory(poses_of(truth, 120.0), {.spacing_s = 0.04});
  ImuSimulation late;
  late.imu.gyroscope.time_offset_s = late.imu.accelerometer.time_offset_s = 0.0173;
  const Matrix3d R_i_b = SO3::exp<double>(Vector3d(0.2, -0.4, 0.1));
  late.imu.gyroscope.T_b_i.R = late.imu.accelerometer.T_b_i.R = R_i_b.transpose();
  const Stamps stamps({Time{} + from_seconds(1.0), 200.0}, from_seconds(18.0));
  const ImuSignal synthetic = simulate_imu(fit.trajectory, {}, stamps).measured;
  const ImuSignal measured = simulate_imu(truth, late, stamps).measured;
  const ImuComparison comparison = compare_imu(synthetic, measured);
  EXPECT_NEAR(comparison.time_offset_s, -0.0173, 1e-5);
  EXPECT_NEAR(SO3::log<double>(comparison.R_second_first.transpose() * R_i_b).norm(), 0.0, 1e-4);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_LT(comparison.gyroscope[static_cast<std::size_t>(axis)].rms, 5e-3);
    EXPECT_LT(comparison.accelerometer[static_cast<std::size_t>(axis)].rms, 5e-2);
    EXPECT_GT(comparison.gyroscope[static_cast<std::size_t>(axis)].correlation.value_or(0.0), 0.9999);
  }
}

}  // namespace
}  // namespace vispline

/// A simulated recording for the estimators, with its truth: the dance in front of points, which is no spline.
#pragma once

#include <utility>

#include "vispline/core/so3.h"
#include "vispline/estimate/assemble.h"
#include "vispline/estimate/assess.h"
#include "vispline/estimate/estimation.h"
#include "vispline/simulate/random_cloud.h"
#include "vispline/simulate/rig_simulation.h"
#include "vispline/trajectory/analytic.h"

namespace vispline::testing {

constexpr double kGravity = 9.81;  // m/s^2

struct SimulatedOptions {
  double duration_s = 6.0;
  double noise = 1.0;  ///< over what the rig says
  bool target = true;  ///< points of a target right ahead; false: a cloud all round, tracked
  std::uint64_t seed = 1;
};

/// A rolling shutter whose clock is late and which looks ahead, a little aside.
inline Camera simulated_camera() {
  Camera camera;
  camera.rate_hz = 20.0;
  camera.lens = {LensModel::kPinhole, (LensParams(4) << 300.0, 301.0, 318.0, 241.0).finished()};
  Pose T_b_c;
  T_b_c.R << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  T_b_c.R = SO3::exp<double>(Vector3d(0.03, -0.05, 0.04)) * T_b_c.R;
  T_b_c.p = Vector3d(0.05, 0.03, -0.02);
  camera.T_c_b = T_b_c.inverse();
  camera.time_offset_s = 0.004;
  camera.shutter.line_delay_s = 4e-5;
  camera.pixel_sigma_px = 0.3;
  return camera;
}

inline Imu simulated_imu() {
  Imu imu;
  imu.rate_hz = 100.0;
  imu.noise.gyro.white = 3e-4;
  imu.noise.accel.white = 2e-3;
  imu.gyroscope.bias = Vector3d(0.01, -0.02, 0.015);
  imu.accelerometer.bias = Vector3d(0.08, -0.05, 0.1);
  return imu;
}

struct Simulated {
  Rig truth;
  Trajectory T_w_b;
  Recording recording;
  TargetPoints target;  ///< frame w

  explicit Simulated(const SimulatedOptions& options = {})
      : T_w_b(analytic_trajectory("dance", Time{}, from_seconds(options.duration_s + 1.0)).value()) {
    truth.imus = {simulated_imu()};
    truth.cameras = {simulated_camera()};
    Scene scene;
    if (options.target) {
      for (int i = 0; i < 49; ++i) {
        const Vector3d point(1.5 + 0.05 * (i % 3), 0.15 * (i % 7 - 3), 0.15 * (i / 7 - 3));
        scene.landmarks.push_back({.id = static_cast<std::uint64_t>(i), .point_w = point});
        target[static_cast<std::uint64_t>(i)] = point;
      }
    } else {
      scene = random_cloud({200, Vector3d(-4.0, -4.0, -3.0), Vector3d(4.0, 4.0, 3.0), options.seed});
      scene.min_distance_m = 0.5;
    }
    Rig noisy = truth;
    noisy.imus[0].noise.gyro.white *= options.noise;
    noisy.imus[0].noise.accel.white *= options.noise;
    noisy.cameras[0].pixel_sigma_px *= options.noise;
    RigSimulation simulation{.g_w = Vector3d(0.0, 0.0, -kGravity), .seed = options.seed};
    simulation.features.tracks.is_target = options.target;
    simulation.features.tracks.max_features = 40;
    recording = simulate(T_w_b, noisy, scene, Time{}, from_seconds(options.duration_s), simulation);
  }

  const ImuSignal& imu() const { return recording.imus.at("imu0"); }

  /// The rig with calibration unlearned: no biases, no clock, the camera turned by 5 deg and moved by 5 cm.
  Rig start() const {
    Rig rig = truth;
    rig.imus[0].gyroscope.bias.setZero();
    rig.imus[0].accelerometer.bias.setZero();
    Camera& camera = rig.cameras[0];
    camera.time_offset_s = 0.0;
    camera.T_c_b.R = SO3::exp<double>(Vector3d(0.05, -0.05, 0.05)) * camera.T_c_b.R;
    camera.T_c_b.p += Vector3d(0.03, -0.03, 0.03);
    return rig;
  }

  /// Poses of a marker frame k on the body in a world m, with a clock of its own.
  Signal<Pose> poses(const Pose& T_b_k, double time_offset_s, double rate_hz, double end_s) const {
    Signal<Pose> poses;
    const SampleClock clock{Time{} + from_seconds(0.1), rate_hz};
    for (std::int64_t i = 0; clock(i) < Time{} + from_seconds(end_s); ++i) {
      poses.push_back(clock(i), T_w_b.at(clock(i) + from_seconds(time_offset_s))->T_w_b() * T_b_k);
    }
    return poses;
  }
};

/// Every number within `sigmas` of the truth, as the result itself counts.
inline void expect_truth(const Estimation& estimation, const Rig& truth, double sigmas) {
  State state = estimation.solution.state;
  state.rig = truth;
  const CalibrationResult result =
      assess(estimation.problem, estimation.solution, {.truth = &state, .check_gradient = false});
  EXPECT_EQ(estimation.solution.status, SolveStatus::kConverged);
  ASSERT_FALSE(result.parameters.empty());
  for (const EstimatedParameter& parameter : result.parameters) {
    if (parameter.name.starts_with("gravity") || parameter.name.starts_with("reference")) continue;
    for (const ParameterComponent& c : parameter.components) {
      ASSERT_TRUE(c.error) << parameter.name;
      EXPECT_LT(std::abs(*c.error), sigmas * c.sigma) << parameter.name << " " << c.name << ": " << c.value;
    }
  }
}

}  // namespace vispline::testing

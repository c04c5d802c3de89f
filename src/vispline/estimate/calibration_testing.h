/// A small calibration with a known answer: the truth is a curve of the model itself, so that errors are those of the
/// noise and nothing else. An IMU and a rolling-shutter camera in front of a target.
#pragma once

#include <memory>
#include <vector>

#include "vispline/core/random.h"
#include "vispline/estimate/estimate_testing.h"
#include "vispline/estimate/imu_measurement.h"
#include "vispline/estimate/target_measurement.h"

namespace vispline::testing {

struct SmallCalibration {
  struct Options {
    double duration_s = 3.0;
    double turn = 1.0;   ///< of the motion about x and y; 0: none
    double noise = 1.0;  ///< over what the measurements assume
    bool rolling_shutter = true;
    std::uint64_t seed = 1;
    std::vector<std::string> free{"cam0.T_c_b", "cam0.time_offset", "imu0.gyroscope.bias", "imu0.accelerometer.bias",
                                  "gravity.direction"};
  };

  static constexpr double kGyroSigma = 3e-3, kAccelSigma = 2e-2, kPixelSigma = 0.3;

  State truth;
  std::vector<Time> imu_time;
  std::vector<ImuSample> imu_sample;
  mutable Problem problem;  ///< solving fixes its weights

  explicit SmallCalibration(const Options& options) : options_(options) {
    make_truth();
    problem.start = truth;
    problem.parameters = parameters_of(truth);
    for (const std::string& name : options.free) {
      for (Parameter* p : find_parameters(problem.parameters, name)) p->treatment.role = Role::kFree;
    }
    measure_imu();
    measure_target();
  }

 private:
  Pose pose_at(Time time) const {
    const double t = to_seconds(time - Time{}), w = options_.turn;
    const Vector3d turn(w * 0.5 * std::sin(4.1 * t), w * 0.45 * std::cos(5.3 * t + 0.4), 0.5 * std::sin(3.7 * t + 1.0));
    const Vector3d place(0.25 * std::sin(3.3 * t), 0.2 * std::cos(4.7 * t), -1.2 + 0.15 * std::sin(5.9 * t + 0.3));
    return {SO3::exp<double>(turn), place};
  }

  void make_truth() {
    truth.curve = make_curve({SplineKind::kJoint, 4, from_seconds(0.1)},
                             {Time{}, Time{} + from_seconds(options_.duration_s)}, [&](Time t) { return pose_at(t); });
    Imu imu;
    imu.gyroscope.bias = Vector3d(0.01, -0.02, 0.015);
    imu.accelerometer.bias = Vector3d(0.05, -0.08, 0.1);
    truth.rig.imus.push_back(imu);
    Camera camera;
    camera.lens = {LensModel::kPinholeRadtan,
                   (LensParams(8) << 420.0, 431.0, 318.0, 241.0, -0.11, 0.02, 0.001, -0.0007).finished()};
    camera.T_c_b = {SO3::exp<double>(Vector3d(0.05, -0.08, 0.1)), Vector3d(0.03, -0.05, 0.02)};
    camera.time_offset_s = 0.004;
    camera.shutter.line_delay_s = options_.rolling_shutter ? 3e-5 : 0.0;
    truth.rig.cameras.push_back(camera);
    truth.g_w = Vector3d(0.8, -0.6, 9.7);
  }

  Vector3d noise(const RandomStream& stream, std::size_t i, double sigma) const {
    const double s = options_.noise * sigma;
    return {s * stream.normal(3 * i), s * stream.normal(3 * i + 1), s * stream.normal(3 * i + 2)};
  }

  void measure_imu() {
    const RandomStream gyro(options_.seed, "gyro"), accel(options_.seed, "accel");
    const Imu& imu = truth.rig.imus[0];
    for (std::size_t i = 0; i < static_cast<std::size_t>(100.0 * options_.duration_s); ++i) {
      imu_time.push_back(Time{} + from_seconds(0.01 * static_cast<double>(i)));
      const BodyState state = truth.curve->state({imu_time.back()});
      imu_sample.push_back(
          {Gyroscope::predict<double>(state, imu.gyroscope, truth.g_w) + noise(gyro, i, kGyroSigma),
           Accelerometer::predict<double>(state, imu.accelerometer, truth.g_w) + noise(accel, i, kAccelSigma)});
    }
    const std::span<const Time> time(imu_time);
    const std::span<const ImuSample> sample(imu_sample);
    for (std::size_t i = 0; i < time.size(); i += 10) {
      problem.measurements.push_back(
          imu_measurement(truth, {0, time.subspan(i, 10), sample.subspan(i, 10), {kGyroSigma, kAccelSigma}, {}}));
    }
  }

  void measure_target() {
    const RandomStream stream(options_.seed, "pixel");
    const Camera& camera = truth.rig.cameras[0];
    std::uint64_t index = 0;
    for (double t = 0.05; t < options_.duration_s - 0.1; t += 0.05) {
      TargetFrame frame{0, Time{} + from_seconds(t), {}, {}, kPixelSigma, {}};
      for (int i = 0; i < 25; ++i) {
        const Vector3d point(0.12 * (i % 5 - 2), 0.12 * (i / 5 - 2), 0.02 * (i % 3));
        const auto px = see(camera, frame.stamp, point);
        const auto z = stream.normal_pair(index++);
        if (!px) continue;
        frame.px.push_back(*px + options_.noise * kPixelSigma * Vector2d(z[0], z[1]));
        frame.point.push_back(point);
      }
      if (!frame.px.empty()) problem.measurements.push_back(target_measurement(truth, std::move(frame)));
    }
  }

  std::optional<Vector2d> see(const Camera& camera, Time stamp, const Vector3d& point) const {
    Vector2d px(320.0, 240.0);
    for (int i = 0; i < 50; ++i) {
      const Pose T_w_b = truth.curve->pose({stamp, camera.delay_s(px)});
      const auto seen = camera.lens.project(camera.T_c_b * (T_w_b.inverse() * point));
      if (!seen) return std::nullopt;
      px = *seen;
    }
    return camera.in_image(px) ? std::optional(px) : std::nullopt;
  }

  Options options_;
};

}  // namespace vispline::testing

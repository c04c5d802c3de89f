/// A synthetic hand-held recording that other estimators have been measured on: 10 s of smooth motion, an IMU at
/// 200 Hz, a rolling-shutter camera at 10 Hz, 300 points. docs/math/estimate.md, The reference problem.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "vispline/core/so3.h"
#include "vispline/estimate/problem.h"
#include "vispline/sensors/recording.h"

namespace vispline::bench {

constexpr double kGyroSigma = 0.01, kAccelSigma = 0.1, kPixelSigma = 0.5;  // rad/s, m/s^2, px
constexpr double kHuber = 5.0;                                             // sigmas
inline const Vector3d kGravity_w{0.0, 0.0, 9.80665};                       // z down

inline Vector3d sines(const Vector3d& size, const Vector3d& hz, const Vector3d& phase, double t, int derivative) {
  const double quarter = 0.5 * std::numbers::pi;
  return Vector3d::NullaryExpr([&](Eigen::Index i) {
    const double rate = 2.0 * std::numbers::pi * hz(i);
    return size(i) * std::pow(rate, derivative) * std::sin(rate * t + phase(i) + quarter * derivative);
  });
}
inline Vector3d position_w(double t, int derivative) {
  return sines({0.8, 0.6, 0.4}, {0.35, 0.27, 0.5}, {0.0, 0.5, 1.0}, t, derivative);
}
inline Vector3d rotation_vector(double t, int derivative) {
  return sines({0.35, 0.30, 0.25}, {0.4, 0.33, 0.55}, {0.0, 0.7, 0.3}, t, derivative);
}
inline Pose true_pose(double t) { return {SO3::exp<double>(rotation_vector(t, 0)), position_w(t, 0)}; }
inline double seconds(Time time) { return to_seconds(time - Time{}); }

struct VsRef {
  double duration_s = 10.0;
  Rig rig{};
  ImuSignal imu{};
  std::vector<Vector3d> points_w{};
  std::vector<Track> tracks{};  ///< of points seen twice or more
  std::vector<std::size_t> point_of_track{};
};

class VsRefSimulation {
 public:
  explicit VsRefSimulation(double duration_s, std::uint64_t seed = 42) : random_(seed) {
    data_.duration_s = duration_s;
    data_.rig.imus.resize(1);
    Camera camera;
    camera.lens.params << 450.0, 450.0, 320.0, 240.0;
    camera.T_c_b = {SO3::exp<double>(Vector3d(0.02, -0.03, 0.01)), {0.05, 0.02, -0.01}};
    camera.shutter.line_delay_s = 0.03 / 480.0;
    data_.rig.cameras.push_back(camera);
    read_imu();
    scatter_points();
    see_points();
  }
  VsRef take() { return std::move(data_); }

 private:
  double normal(double sigma) { return sigma * normal_(random_); }
  Vector3d noise(double sigma) {
    return Vector3d::NullaryExpr([&](Eigen::Index) { return normal(sigma); });
  }

  void read_imu() {
    for (int i = 0; i < std::lround(200.0 * data_.duration_s); ++i) {
      const Time time = Time{} + from_seconds(0.0513 + 0.005 * i);
      const Vector3d phi = rotation_vector(seconds(time), 0);
      const Vector3d gyro = SO3::left_jacobian<double>(-phi) * rotation_vector(seconds(time), 1);
      const Vector3d accel = SO3::exp<double>(phi).transpose() * (position_w(seconds(time), 2) - kGravity_w);
      data_.imu.push_back(time, {gyro + noise(kGyroSigma), accel + noise(kAccelSigma)});
    }
  }

  void scatter_points() {
    std::uniform_real_distribution<double> x(-4.0, 4.0), y(-3.0, 3.0), z(3.0, 6.0);
    for (int i = 0; i < 300; ++i) {
      const double px = x(random_), py = y(random_), pz = z(random_);
      data_.points_w.emplace_back(px, py, pz);
    }
  }

  std::optional<Vector2d> project(const Camera& camera, Time stamp, const Vector3d& point_w) const {
    Vector2d px(320.0, 240.0);
    for (int i = 0; i < 20; ++i) {
      const Pose T_w_b = true_pose(seconds(stamp) + camera.delay_s(px));
      const auto image = camera.lens.project(camera.T_c_b * (T_w_b.inverse() * point_w));
      if (!image) return std::nullopt;
      px = *image;
    }
    return camera.in_image(px) ? std::optional(px) : std::nullopt;
  }

  void see_points() {
    const Camera& camera = data_.rig.cameras[0];
    std::bernoulli_distribution kept(0.4);
    std::vector<Track> tracks(data_.points_w.size());
    for (int f = 0; f < std::lround(10.0 * data_.duration_s); ++f) {
      const Time stamp = Time{} + from_seconds(0.0517 + 0.1 * f);
      for (std::size_t i = 0; i < tracks.size(); ++i) {
        const auto px = project(camera, stamp, data_.points_w[i]);
        if (!px || !kept(random_)) continue;
        const double noise_x = normal(kPixelSigma), noise_y = normal(kPixelSigma);
        tracks[i].sightings.push_back({0, stamp, *px + Vector2d(noise_x, noise_y)});
      }
    }
    for (std::size_t i = 0; i < tracks.size(); ++i) {
      if (tracks[i].sightings.size() < 2) continue;
      tracks[i].landmark = data_.tracks.size();
      data_.tracks.push_back(tracks[i]);
      data_.point_of_track.push_back(i);
    }
  }

  VsRef data_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
};

}  // namespace vispline::bench

/// Where the body and the points are, once it is known how the body turns: linear least squares over positions, points,
/// gravity and accelerometer bias. docs/math/estimate.md, Start values (linear structure and motion).
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "vispline/estimate/track.h"
#include "vispline/sensors/recording.h"

namespace vispline {

struct TrackStartInput {
  Rig rig{};  ///< lenses, T_c_b, clocks as far as they are known
  std::function<Matrix3d(Time)> R_w_b{};
  std::span<const Time> imu_time{};
  std::span<const ImuSample> imu{};
  std::vector<Track> tracks{};
  double accel_sigma = 0.1;  ///< m/s^2: noise and what the rotations are off by
  double bearing_sigma = 3e-3;
  double gravity = 9.80665;
  Duration spacing = from_seconds(0.1);
  TimeSpan span{};
};

struct TrackStart {
  std::function<Vector3d(Time)> p_w{};  ///< m
  Vector3d g_w = Vector3d::Zero();
  Vector3d accel_bias = Vector3d::Zero();
  std::vector<std::optional<Vector3d>> point_w{};  ///< by track; empty: not determined, or behind its camera
  double bearing_rms = 0.0;                        ///< rad
};

/// Empty if the system has no full rank: too little translation or too few tracks.
std::optional<TrackStart> start_from_tracks(const TrackStartInput& input);

}  // namespace vispline

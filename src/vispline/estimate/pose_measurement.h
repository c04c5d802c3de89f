/// Poses or positions of the body from outside: motion capture, GNSS, and the rows that hold the gauge.
/// docs/math/estimate.md, Outside poses.
#pragma once

#include <memory>
#include <span>

#include "vispline/core/pose.h"
#include "vispline/estimate/measurement.h"

namespace vispline {

struct PoseBatch {
  std::size_t reference = 0;  ///< of the state
  std::span<const Time> time{};
  std::span<const Pose> T_m_k{};
  double position_sigma_m = 1.0;
  double rotation_sigma_rad = 1.0;  ///< 0: the rotations were not measured
  Huber loss{};                     ///< of position and of rotation
};

/// Residuals of T_m_k = T_m_w T_w_b(t) T_b_k: position in m, rotation Log(R_measured^T R_predicted).
std::unique_ptr<Measurement> pose_measurement(const State& state, const PoseBatch& batch);

/// What nothing measures is held where it is: position at one instant, and its yaw or its whole rotation. These rows
/// can always be met exactly, so they move no estimate.
struct Gauge {
  Time time{};
  Pose T_w_b{};
  bool whole_rotation = false;  ///< false: about the vertical only
};
std::unique_ptr<Measurement> gauge_measurement(const Gauge& gauge);

}  // namespace vispline

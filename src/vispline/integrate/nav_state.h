/// What dead reckoning carries from sample to sample.
#pragma once

#include <Eigen/Geometry>

#include "vispline/core/body_state.h"
#include "vispline/core/pose.h"
#include "vispline/core/types.h"

namespace vispline {

/// Attitude, position and velocity of body b (= the IMU) in world w.
struct NavState {
  /// A unit quaternion, except under the course rules whose defect it is to let its norm grow.
  Eigen::Quaterniond q_w_b = Eigen::Quaterniond::Identity();
  Vector3d p_w = Vector3d::Zero();  ///< m
  Vector3d v_w = Vector3d::Zero();  ///< m/s

  /// The pose, with the quaternion normalised.
  Pose T_w_b() const { return {q_w_b.normalized().toRotationMatrix(), p_w}; }
};

/// The part of a true state that dead reckoning starts from.
inline NavState nav_state(const BodyState& state) { return {Eigen::Quaterniond(state.R_w_b), state.p_w, state.v_w}; }

}  // namespace vispline

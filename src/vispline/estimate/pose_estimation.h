/// IMU and poses from outside, motion capture above all: clock, lever arm, rotation, biases and the motion itself,
/// found without a start value. docs/math/estimate.md, Outside poses.
#pragma once

#include "vispline/estimate/assemble.h"
#include "vispline/estimate/estimation.h"
#include "vispline/sensors/recording.h"

namespace vispline {

struct PoseEstimationOptions {
  CurveShape curve{SplineKind::kJoint, 4, from_seconds(0.02)};
  double gravity = 9.80665;             ///< m/s^2
  Treatments treatments{};              ///< beyond the usual ones
  double huber_sigmas = 3.0;            ///< of poses; 0: least squares
  bool trust_noise = false;             ///< sigmas as the rig has them; false: found from the residuals
  std::optional<Duration> bias_walk{};  ///< between nodes of biases that walk; empty: constant biases
  SolveOptions solve{};
};

/// The world is that of the poses. `T_b_k` of the result's reference 0 is what they track, its time offset their clock.
/// `imu` and `poses` must outlive the result. Throws the verdicts of align_poses() and E-OVERLAP.
Estimation estimate_with_poses(const Rig& start, const ImuSignal& imu, const Signal<Pose>& poses,
                               const PoseEstimationOptions& options);

}  // namespace vispline

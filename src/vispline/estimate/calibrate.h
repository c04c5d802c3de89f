/// Camera-IMU calibration with a known target: from corners and an IMU to the whole rig, without start values but those
/// of the lenses. docs/math/estimate.md, Calibration.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "vispline/estimate/assemble.h"
#include "vispline/estimate/estimation.h"
#include "vispline/estimate/pose_alignment.h"

namespace vispline {

struct CalibrateOptions {
  CurveShape curve{SplineKind::kJoint, 4, from_seconds(0.02)};
  double gravity = 9.80665;             ///< m/s^2
  Treatments treatments{};              ///< beyond the usual ones
  double huber_sigmas = 3.0;            ///< of corners; 0: least squares
  bool trust_noise = false;             ///< sigmas as the rig has them; false: found from the residuals
  std::optional<Duration> bias_walk{};  ///< between nodes of biases that walk; empty: constant biases
  SolveOptions solve{};
};

/// The world is the frame of the target. `recording` must outlive the result. Throws Error(kUnfit) with the verdicts of
/// align_poses(), E-TARGET if no camera sees enough of the target, E-OVERLAP.
Estimation calibrate(const Rig& start, const Recording& recording, const TargetPoints& target,
                     const CalibrateOptions& options);

}  // namespace vispline

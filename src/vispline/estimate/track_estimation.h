/// Spline Fusion proper: tracks of unknown points and an IMU, to trajectory, points and the whole rig. Lovegrove et al.
/// 2013. docs/math/estimate.md, Tracks.
#pragma once

#include "vispline/estimate/assemble.h"
#include "vispline/estimate/estimation.h"
#include "vispline/sensors/recording.h"

namespace vispline {

struct TrackEstimationOptions {
  CurveShape curve{SplineKind::kJoint, 4, from_seconds(0.05)};
  LandmarkUnknowns unknowns = LandmarkUnknowns::kPoint;
  double gravity = 9.80665;             ///< m/s^2
  Treatments treatments{};              ///< beyond the usual ones
  double huber_sigmas = 3.0;            ///< of features; 0: least squares
  bool trust_noise = false;             ///< sigmas as the rig has them; false: found from the residuals
  std::optional<Duration> bias_walk{};  ///< between nodes of biases that walk; empty: constant biases
  bool trust_clocks = false;  ///< camera clocks and rotations as the rig has them; false: found from the tracks
  SolveOptions solve{};
};

/// The world has its z axis up and begins near the first pose; nothing else about it can be known. `recording` must
/// outlive the result. Throws Error(kUnfit): E-TRACKS (too few), E-CLOCK, E-EXCITATION, E-UNITS, E-OVERLAP.
Estimation estimate_with_tracks(const Rig& start, const Recording& recording, const TrackEstimationOptions& options);

}  // namespace vispline

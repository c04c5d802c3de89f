/// How far apart knots may be for the motion that an IMU measured, in the spirit of Spline Error Weighting (Ovren and
/// Forssen, CVPR 2018). docs/math/estimate.md, Knot spacing.
#pragma once

#include <string>

#include "vispline/sensors/recording.h"

namespace vispline {

struct KnotSpacingChoice {
  double spacing_s = 0.02;
  double gyro_loss = 0.0;   ///< rad/s: what a spline with these knots leaves of the angular rate, standard deviation
  double accel_loss = 0.0;  ///< m/s^2
  double gyro_noise = 0.0;  ///< rad/s per sample, from the top of the spectrum
  double accel_noise = 0.0;
  std::string why{};  ///< one sentence with these numbers
};

/// The longest spacing, from 0.2 s down to 0.01 s, at which a spline of this order leaves less of the motion than
/// `share` of the noise of one sample. The angular rate is a first derivative of the curve and specific force a second
/// one, so that they are splines of orders one and two lower.
KnotSpacingChoice choose_knot_spacing(const ImuSignal& imu, int order = 4, double share = 0.35);

}  // namespace vispline

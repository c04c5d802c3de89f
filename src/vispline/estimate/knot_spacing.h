/// How far apart knots may be for the motion that an IMU measured: Spline Error Weighting (Ovren & Forssen, CVPR 2018),
/// turned round. docs/math/estimate.md, Knot spacing.
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

/// The longest spacing, from 0.2 s down, at which a cubic spline leaves less of the motion than `share` of the noise of
/// one sample, in gyroscope and accelerometer. The frequency response of the spline is that of the paper.
KnotSpacingChoice choose_knot_spacing(const ImuSignal& imu, double share = 0.5);

}  // namespace vispline

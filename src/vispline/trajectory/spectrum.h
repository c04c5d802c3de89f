/// What the spectrum of measured poses says about the motion, the noise, and the knots a spline needs.
/// docs/math/fit.md, equations (7)-(12).
#pragma once

#include "vispline/core/pose.h"
#include "vispline/core/signal.h"

namespace vispline {

/// One kind of motion, averaged over its three axes. `unit` is m for translation, rad for rotation.
struct MotionSpectrum {
  double noise_sigma = 0.0;   ///< of measurement noise that is white as at the bandwidth, unit
  double bandwidth_hz = 0.0;  ///< where the motion sinks below the noise
  double jerk_density = 0.0;  ///< prior of the fit with the least expected error of the derivative, unit/s^3/sqrt(Hz)
  double spacing_s = 0.0;     ///< largest knot spacing that keeps `quality` of the energy of the motion's derivative
                              ///< and adds at most 1 % to the error (variance) that the noise leaves
};

struct PoseSpectrum {
  MotionSpectrum translation;  ///< energy of the acceleration
  MotionSpectrum rotation;     ///< energy of the angular rate
};

/// Needs at least 64 poses in one piece without a gap; throws Error E-FIT-SHORT otherwise.
/// quality in (0, 1): share of the energy that the spline has to carry.
PoseSpectrum analyse_spectrum(const Signal<Pose>& poses, double quality);

/// Amplitude response of a uniform cubic B-spline fitted to a sinusoid of f * spacing cycles per knot, 1 at zero.
double cubic_spline_response(double cycles_per_knot);

}  // namespace vispline

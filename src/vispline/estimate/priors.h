/// What is known beforehand: parameters, how a bias walks, that a body does not jump. docs/math/estimate.md, Priors.
#pragma once

#include <memory>

#include "vispline/estimate/measurement.h"

namespace vispline {

/// The parameter stays within its treatment's sigma of the value it has in `start`.
std::unique_ptr<Measurement> prior_measurement(const State& start, const Parameter& parameter);

/// Steps between the nodes of a walking bias: K sqrt(spacing), K in rad/s^2/sqrt(Hz) and m/s^3/sqrt(Hz). The node in
/// the middle is held at zero: the constant bias is that of the middle of the recording.
std::unique_ptr<Measurement> bias_walk_measurement(const State& state, std::size_t imu, double gyro_walk,
                                                   double accel_walk);

/// Weak: holds knots that nothing measures. Steps of the increments between knots within acceleration_sigma spacing^2.
struct Smoothness {
  double acceleration_sigma = 300.0;  ///< m/s^2
  double alpha_sigma = 300.0;         ///< rad/s^2
};
std::unique_ptr<Measurement> smoothness_measurement(const Smoothness& smoothness, std::size_t first_knot,
                                                    std::size_t last_knot);

}  // namespace vispline

/// What imu_utils prints for a record, by its own recipe, so that its numbers can be compared and understood.
/// docs/math/allan.md, imu_utils.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vispline/allan/result.h"

namespace vispline {

/// Its cluster sizes for n readings: 100 values evenly spaced in the logarithm from 1 to the largest power of two below
/// n / 2, rounded up, repeats left out.
std::vector<std::int64_t> imu_utils_factors(std::int64_t readings);

/// Its fit (five terms, unweighted, of log10 of the variance) and what it prints. `deviation` [unit] at each factor;
/// `unit` "rad/s" is treated as the gyroscope is there, everything else as the accelerometer.
ImuUtilsNumbers imu_utils_numbers(std::span<const std::int64_t> factors, std::span<const double> deviation,
                                  double rate_hz, std::string_view unit);

}  // namespace vispline

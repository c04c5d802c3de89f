/// Equivalent degrees of freedom of deviations: how sure a point of a curve is.
/// C. Greenhall, W. Riley, Uncertainty of stability variances based on finite differences, PTTI 2003.
/// docs/math/allan.md (10)-(13).
#pragma once

#include <cstdint>
#include <span>

#include "vispline/allan/deviation.h"

namespace vispline {

/// A part of the noise: power law alpha of the frequency (2 white phase, 1 flicker phase, 0 white frequency, -1
/// flicker, -2 random walk) and its share of the variance at this averaging factor. Shares sum to 1.
struct NoiseShare {
  int alpha = 0;
  double share = 1.0;
};

/// Degrees of freedom (at least 1) of a deviation over `points` phase points at factor m, for a mixture of independent
/// Gaussian noises. Third differences bear alpha -4 and up, second differences -2 and up; lower ones count as that.
double edf_of(Deviation kind, std::span<const NoiseShare> noise, std::int64_t m, std::int64_t points);

/// For one power law.
double edf_of(Deviation kind, int alpha, std::int64_t m, std::int64_t points);

}  // namespace vispline

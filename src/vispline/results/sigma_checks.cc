#include "vispline/results/sigma_checks.h"

#include <cmath>

namespace vispline {

Band nees_band(int states, int runs, double sigmas) {
  const double n = static_cast<double>(states) * static_cast<double>(runs);
  const auto quantile = [n](double z) { return std::pow(1.0 - 2.0 / (9.0 * n) + z * std::sqrt(2.0 / (9.0 * n)), 3.0); };
  return {quantile(-sigmas), quantile(sigmas)};
}

}  // namespace vispline

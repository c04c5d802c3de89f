/// The 1000-point set of NIST SP 1065, page 107: frequencies from a multiplicative congruential generator.
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

#include "vispline/allan/deviation.h"

namespace vispline::testing {

inline std::vector<double> nbs14_frequencies() {
  std::vector<double> y;
  std::int64_t n = 1234567890;
  for (int i = 0; i < 1000; ++i) {
    y.push_back(static_cast<double>(n) / 2147483647.0);
    n = 16807 * n % 2147483647;
  }
  return y;
}

/// Its phase, mean taken off: 1001 points, tau0 = 1 s.
inline Phase nbs14_phase() {
  const std::vector<double> y = nbs14_frequencies();
  return phase_of(y, 1.0, std::accumulate(y.begin(), y.end(), 0.0) / 1000.0);
}

}  // namespace vispline::testing

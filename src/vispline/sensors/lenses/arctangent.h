/// atan(r) / r as a function of q = r^2, which is smooth at 0: behind the equidistant and the FOV model.
#pragma once

#include <cmath>

namespace vispline::lenses {

/// Below this q the power series is used; twelve terms leave less than 1e-18 there.
inline constexpr double kArctangentSeries = 1.0 / 32.0;

/// atan(sqrt(q)) / sqrt(q), q >= 0.
template <class T>
T arctangent_ratio(const T& q) {
  using std::atan, std::sqrt;
  if (q < T(kArctangentSeries)) {
    T sum = T(1.0 / 25.0);
    for (int n = 11; n >= 0; --n) sum = T(1.0 / (2 * n + 1)) - q * sum;
    return sum;
  }
  const T r = sqrt(q);
  return atan(r) / r;
}

/// d arctangent_ratio / dq, given the ratio.
inline double arctangent_ratio_slope(double q, double ratio) {
  if (q < kArctangentSeries) {
    double sum = 13.0 / 27.0;
    for (int n = 12; n >= 1; --n) sum = n / (2.0 * n + 1.0) - q * sum;
    return -sum;
  }
  return 0.5 * (1.0 / (1.0 + q) - ratio) / q;
}

}  // namespace vispline::lenses

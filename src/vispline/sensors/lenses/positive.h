/// Whether a polynomial stays positive: what the domain of a distortion comes down to.
#pragma once

#include <array>
#include <cstddef>

namespace vispline::lenses {

namespace detail {

/// All Bernstein coefficients positive: so is the polynomial. An end not positive: it is not. Else both halves are
/// asked; a root that is only touched counts as not positive.
template <class T>
bool positive_bernstein(const std::array<T, 5>& b, int depth) {
  if (!(b[0] > T(0) && b[4] > T(0))) return false;
  if (b[1] > T(0) && b[2] > T(0) && b[3] > T(0)) return true;
  if (depth == 0) return false;
  std::array<T, 5> left, right = b;
  for (std::size_t i = 0; i < 5; ++i) {  // de Casteljau at the middle
    left[i] = right[0];
    for (std::size_t j = 0; j + i + 1 < 5; ++j) right[j] = T(0.5) * (right[j] + right[j + 1]);
  }
  return positive_bernstein(left, depth - 1) && positive_bernstein(right, depth - 1);
}

}  // namespace detail

/// a[0] + a[1] s + ... + a[4] s^4 > 0 for all s in [0, x]; x >= 0. False if anything is not a number.
template <class T>
bool positive_on(const std::array<T, 5>& a, const T& x) {
  const auto negative_part = [](const T& value) { return value < T(0) ? value : T(0); };
  const T bound = a[0] + x * (negative_part(a[1]) +
                              x * (negative_part(a[2]) + x * (negative_part(a[3]) + x * negative_part(a[4]))));
  if (bound > T(0)) return true;
  const T b1 = a[1] * x, b2 = a[2] * x * x, b3 = a[3] * x * x * x, b4 = a[4] * x * x * x * x;
  return detail::positive_bernstein<T>(
      {a[0], a[0] + T(1.0 / 4.0) * b1, a[0] + T(1.0 / 2.0) * b1 + T(1.0 / 6.0) * b2,
       a[0] + T(3.0 / 4.0) * b1 + T(1.0 / 2.0) * b2 + T(1.0 / 4.0) * b3, a[0] + b1 + b2 + b3 + b4},
      50);
}

}  // namespace vispline::lenses

/// Power that each noise term puts into the sine transform of a differenced series. docs/math/allan.md (14)-(19).
#pragma once

#include <array>
#include <cstdint>

namespace vispline {

/// Terms with a variance, in the order of Term: Q^2, N^2, B^2, K^2. The ramp is a mean, not a variance.
inline constexpr std::size_t kVariances = 4;
using TermPowers = std::array<double, kVariances>;

/// A series of `length` means of `averaged` raw readings each, step_s apart; its differences y, transformed by
///   z_j = sqrt(2 / length) sum_k sin(pi j k / length) y_k,  j = 1 .. length - 1.
struct DifferencedSeries {
  std::int64_t length = 0;
  std::int64_t averaged = 1;
  double step_s = 0.0;
};

/// E[z_j^2] of each term with coefficient 1. Exact for white noise and random walk, whose differences the transform
/// decorrelates; flicker includes its leakage at low j.
TermPowers term_powers(const DifferencedSeries& series, std::int64_t j);

/// E[z_j] of a ramp of 1 unit/s.
double ramp_mean(const DifferencedSeries& series, std::int64_t j);

}  // namespace vispline

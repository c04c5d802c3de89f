/// Cumulative basis of the uniform B-spline of order K (degree K-1). docs/math/spline.md, equations (1)-(3);
/// Lovegrove et al. 2013, equations (1)-(3) for K = 4.
#pragma once

#include <array>
#include <cstddef>

namespace vispline {
namespace detail {

constexpr double binomial(int n, int k) {
  double value = 1.0;
  for (int i = 1; i <= k; ++i) value = value * (n - k + i) / i;
  return value;
}

constexpr double power(int base, int exponent) {
  double value = 1.0;
  for (int i = 0; i < exponent; ++i) value *= base;
  return value;
}

}  // namespace detail

/// Polynomial coefficients of lambda_j(u) = sum_n C[j][n] u^n, j = 0..K-1, u in [0, 1]; lambda_0 = 1.
template <int K>
constexpr std::array<std::array<double, K>, K> cumulative_basis_matrix() {
  std::array<std::array<double, K>, K> matrix{};
  double factorial = 1.0;
  for (int i = 2; i < K; ++i) factorial *= i;
  for (int j = 0; j < K; ++j) {
    for (int n = 0; n < K; ++n) {
      double sum = 0.0;
      for (int s = j; s < K; ++s) {
        for (int l = s; l < K; ++l) {
          const double sign = (l - s) % 2 == 0 ? 1.0 : -1.0;
          sum += sign * detail::binomial(K, l - s) * detail::power(K - 1 - l, K - 1 - n);
        }
      }
      matrix[static_cast<std::size_t>(j)][static_cast<std::size_t>(n)] = detail::binomial(K - 1, n) / factorial * sum;
    }
  }
  return matrix;
}

/// lambda_j and its first three derivatives with respect to time, for the K-1 increments j = 1..K-1 (stored from 0).
template <int K, class T = double>
struct CumulativeBasis {
  static_assert(K >= 2 && K <= 8);
  static constexpr std::size_t kIncrements = K - 1;
  std::array<T, kIncrements> value, d1, d2, d3;

  /// u in [0, 1]: place in the segment; spacing_s: knot spacing, s.
  CumulativeBasis(const T& u, double spacing_s) {
    const double per_s = 1.0 / spacing_s;
    for (std::size_t j = 0; j < kIncrements; ++j) {
      const auto& c = kMatrix[j + 1];
      T p0 = T(c[K - 1]), p1 = T(0), p2 = T(0), p3 = T(0);
      for (std::size_t n = K - 1; n-- > 0;) {  // Horner for the polynomial and p', p''/2, p'''/6 at once
        p3 = p3 * u + p2;
        p2 = p2 * u + p1;
        p1 = p1 * u + p0;
        p0 = p0 * u + T(c[n]);
      }
      value[j] = p0;
      d1[j] = p1 * per_s;
      d2[j] = p2 * (2.0 * per_s * per_s);
      d3[j] = p3 * (6.0 * per_s * per_s * per_s);
    }
  }

  static constexpr auto kMatrix = cumulative_basis_matrix<K>();
};

}  // namespace vispline

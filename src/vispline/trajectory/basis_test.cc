#include "vispline/trajectory/basis.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vispline {
namespace {

TEST(Basis, CubicMatrixIsThePapersC) {
  // Lovegrove et al. 2013, equation (3): C = 1/6 [6 0 0 0; 5 3 -3 1; 1 3 3 -2; 0 0 0 1].
  const double paper[4][4] = {{6, 0, 0, 0}, {5, 3, -3, 1}, {1, 3, 3, -2}, {0, 0, 0, 1}};
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t n = 0; n < 4; ++n) EXPECT_NEAR(cumulative_basis_matrix<4>()[j][n], paper[j][n] / 6.0, 1e-15);
  }
}

/// The basis function of order K on knots 0, 1, ..., K by de Boor's recursion: an independent definition.
double de_boor(int order, double x) {
  if (order == 1) return x >= 0.0 && x < 1.0 ? 1.0 : 0.0;
  return (x * de_boor(order - 1, x) + (order - x) * de_boor(order - 1, x - 1.0)) / (order - 1);
}

template <int K>
void expect_sums_of_de_boor() {
  for (const double u : {0.0, 0.1, 0.5, 0.73, 0.999}) {
    const CumulativeBasis<K> basis(u, 0.1);
    for (int j = 1; j < K; ++j) {
      double sum = 0.0;
      for (int m = j; m < K; ++m) sum += de_boor(K, u + K - 1 - m);
      EXPECT_NEAR(basis.value[static_cast<std::size_t>(j - 1)], sum, 1e-14)
          << "order " << K << " u " << u << " j " << j;
    }
  }
}

TEST(Basis, IsTheCumulativeSumOfDeBoor) {
  expect_sums_of_de_boor<4>();
  expect_sums_of_de_boor<5>();
  expect_sums_of_de_boor<6>();
}

TEST(Basis, DerivativesArePerSecond) {
  const double spacing_s = 0.2, u = 0.37, h = 1e-4;
  const CumulativeBasis<6> at(u, spacing_s), after(u + h, spacing_s), before(u - h, spacing_s);
  for (std::size_t j = 0; j < 5; ++j) {
    const double per_s = 1.0 / (2.0 * h * spacing_s);
    EXPECT_NEAR(at.d1[j], (after.value[j] - before.value[j]) * per_s, 1e-6);
    EXPECT_NEAR(at.d2[j], (after.d1[j] - before.d1[j]) * per_s, 1e-5);
    EXPECT_NEAR(at.d3[j], (after.d2[j] - before.d2[j]) * per_s, 1e-4);
  }
}

}  // namespace
}  // namespace vispline

#include "vispline/trajectory/taylor.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vispline {
namespace {

constexpr double kT = 0.83;

/// Compares with derivatives worked out by hand.
void expect_near(const Taylor& f, double value, double d1, double d2) {
  EXPECT_NEAR(f.value, value, 1e-15 * (1.0 + std::abs(value)));
  EXPECT_NEAR(f.d1, d1, 1e-14 * (1.0 + std::abs(d1)));
  EXPECT_NEAR(f.d2, d2, 1e-14 * (1.0 + std::abs(d2)));
}

TEST(Taylor, ConstantsAndTime) {
  expect_near(Taylor(3.5), 3.5, 0, 0);
  expect_near(Taylor::time(kT), kT, 1, 0);
}

TEST(Taylor, PolynomialArithmetic) {
  const Taylor t = Taylor::time(kT);
  expect_near(2.0 - t * t * t + 4.0 * t - 1.0, 1 - kT * kT * kT + 4 * kT, 4 - 3 * kT * kT, -6 * kT);
  expect_near(-(t * 3.0), -3 * kT, -3, 0);
}

TEST(Taylor, QuotientRule) {
  const Taylor t = Taylor::time(kT);
  const double n = 1 + kT * kT;  // d/dt t/n = (1 - t^2)/n^2, then 2 t (t^2 - 3)/n^3
  expect_near(t / (1.0 + t * t), kT / n, (1 - kT * kT) / (n * n), 2 * kT * (kT * kT - 3) / (n * n * n));
}

TEST(Taylor, SineAndCosineOfASquare) {
  const Taylor t = Taylor::time(kT);
  const double s = std::sin(kT * kT), c = std::cos(kT * kT);
  expect_near(sin(t * t), s, 2 * kT * c, 2 * c - 4 * kT * kT * s);
  expect_near(cos(t * t), c, -2 * kT * s, -2 * s - 4 * kT * kT * c);
}

TEST(Taylor, SquareRootUndoesTheSquare) {
  const Taylor f = 1.5 + sin(Taylor::time(kT));
  expect_near(sqrt(f * f), f.value, f.d1, f.d2);
}

TEST(Taylor, Atan2FollowsTheAngleThroughEveryQuadrant) {
  for (double angle = -3.0; angle < 3.1; angle += 0.37) {
    const Taylor phase = angle + 2.0 * Taylor::time(0.0) + 0.7 * Taylor::time(0.0) * Taylor::time(0.0);
    const Taylor radius = 3.0 + Taylor::time(0.0) * 0.4;
    expect_near(atan2(radius * sin(phase), radius * cos(phase)), angle, 2.0, 1.4);
  }
}

}  // namespace
}  // namespace vispline

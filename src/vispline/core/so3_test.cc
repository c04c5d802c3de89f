#include "vispline/core/so3.h"

#include <gtest/gtest.h>

#include <unsupported/Eigen/MatrixFunctions>

#include "vispline/core/lie_testing.h"

namespace vispline::testing {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(SO3, HatIsTheCrossProductAndVeeUndoesIt) {
  const Vector3d a(1.0, -2.0, 3.0), b(0.4, 0.5, -0.6);
  EXPECT_EQ(distance(hat(a) * b, a.cross(b)), 0.0);
  EXPECT_EQ(distance(vee(hat(a)), a), 0.0);
  EXPECT_LT(distance(hat_squared(a), hat(a) * hat(a)), 1e-14);
}

TEST(SO3, VeeIgnoresTheSymmetricPart) {
  const Vector3d a(1.0, -2.0, 3.0);
  const Matrix3d symmetric = (Matrix3d() << 1, 2, 3, 2, 4, 5, 3, 5, 6).finished();
  EXPECT_EQ(distance(vee<double>(hat(a) + symmetric), a), 0.0);
}

TEST(SO3, QuarterTurnAboutZTakesXToY) {
  const Matrix3d R = SO3::exp<double>(Vector3d(0, 0, kPi / 2));
  EXPECT_LT(distance(R * Vector3d::UnitX(), Vector3d::UnitY()), 1e-15);
}

TEST(SO3, ExpIsTheMatrixExponential) {
  for (const Vector3d& w : nasty_tangents<SO3>()) {
    const Matrix3d W = hat(w);
    EXPECT_LT(distance(SO3::exp<double>(w), W.exp()), 1e-14) << w.transpose();
  }
}

TEST(SO3, ExpIsARotation) {
  for (const Vector3d& w : tangents<SO3>({0.0, 1e-12, 1e-4, 1.0, 3.0, kPi, 5.0, 20.0})) {
    const Matrix3d R = SO3::exp<double>(w);
    EXPECT_LT(distance(R * R.transpose(), Matrix3d::Identity()), 2e-14) << w.norm();
    EXPECT_NEAR(R.determinant(), 1.0, 2e-14);
  }
}

TEST(SO3, LogOfHalfTurns) {
  for (const Vector3d& axis : {Vector3d::UnitX().eval(), Vector3d::UnitY().eval(), Vector3d::UnitZ().eval(),
                               Vector3d(1, 1, 0).normalized(), Vector3d(-1, 2, 3).normalized()}) {
    const Matrix3d R = 2.0 * axis * axis.transpose() - Matrix3d::Identity();
    const Vector3d w = SO3::log<double>(R);
    EXPECT_NEAR(w.norm(), kPi, 1e-14);
    EXPECT_LT(w.cross(axis).norm(), 1e-14);
  }
}

TEST(SO3, LogIsAtMostPi) {
  const Vector3d w = SO3::log<double>(SO3::exp<double>(Vector3d(0, 0, 1.5 * kPi)));
  EXPECT_LT(distance(w, Vector3d(0, 0, -0.5 * kPi)), 1e-14);
}

/// sum_n (-1)^n x^n / (2n + offset)! and its derivatives, summed in long double far beyond the terms of the library.
long double factorial_sum(long double x, int offset, int derivative) {
  long double sum = 0.0L;
  for (int n = derivative; n < 40; ++n) {
    long double term = n % 2 == 0 ? 1.0L : -1.0L;
    for (int k = 1; k <= 2 * n + offset; ++k) term /= k;
    for (int k = 0; k < derivative; ++k) term *= n - k;
    for (int k = 0; k < n - derivative; ++k) term *= x;
    sum += term;
  }
  return sum;
}

TEST(SO3, SeriesAndClosedFormsAgreeWithLongSums) {
  for (const double x : {0.0, 1e-24, 1e-8, 0.5, 1.0 - 1e-15, 1.0, 1.0 + 1e-15, 4.0, kPi * kPi}) {
    const RotationSeries<double> s(x);
    const auto expect = [x](double actual, int offset, int derivative) {
      const auto expected = static_cast<double>(factorial_sum(x, offset, derivative));
      EXPECT_NEAR(actual / expected, 1.0, 1e-12) << "x " << x << " offset " << offset << " derivative " << derivative;
    };
    expect(s.b, 2, 0);
    expect(s.c, 3, 0);
    expect(s.db, 2, 1);
    expect(s.dc, 3, 1);
    expect(s.ddb, 2, 2);
  }
}

}  // namespace
}  // namespace vispline::testing

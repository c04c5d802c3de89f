#include "vispline/results/imu_spline.h"

#include <gtest/gtest.h>

#include "vispline/results/imu_signal_testing.h"

namespace vispline {
namespace {

Vector6d stacked(const ImuSample& sample) {
  Vector6d value;
  value << sample.gyro, sample.accel;
  return value;
}

/// Largest error well inside the signal, between its samples.
double worst_error(double rate_hz) {
  const TestMotion motion(1);
  const ImuSpline spline(observe(motion, {.rate_hz = rate_hz, .end_s = 5.0}), 0.05);
  double worst = 0.0;
  for (double s = 1.0; s < 4.0; s += 0.00317) {
    worst = std::max(worst, (spline.value(*spline.interval(s), s) - stacked(motion(s))).norm());
  }
  return worst;
}

TEST(ImuSpline, IsOfFourthOrder) {
  EXPECT_LT(worst_error(200.0), 1e-4);
  EXPECT_NEAR(std::log2(worst_error(100.0) / worst_error(200.0)), 4.0, 0.3);
}

TEST(ImuSpline, PassesThroughSamplesSmoothly) {
  const ImuSignal imu = with_losses(observe(TestMotion(2), {.rate_hz = 100.0, .end_s = 2.0}), 3);
  const ImuSpline spline(imu, 0.2);
  for (std::size_t i = 1; i + 1 < imu.size(); ++i) {
    const double s = to_seconds(imu.time[i] - imu.time[0]);
    EXPECT_LT((spline.value(i, s) - stacked(imu.value[i])).norm(), 1e-12);
    EXPECT_LT((spline.value(i - 1, s) - stacked(imu.value[i])).norm(), 1e-12);
    EXPECT_LT((spline.rate(i, s) - spline.rate(i - 1, s)).norm(), 1e-9 * (1.0 + spline.rate(i, s).norm()));
  }
}

TEST(ImuSpline, RateIsTheDerivative) {
  const ImuSpline spline(observe(TestMotion(4), {.rate_hz = 50.0, .end_s = 2.0}), 0.2);
  constexpr double h = 1e-6;
  for (const double s : {0.003, 0.5111, 1.0001, 1.9555}) {
    const std::size_t i = *spline.interval(s);
    const Vector6d difference = (spline.value(i, s + h) - spline.value(i, s - h)) / (2.0 * h);
    EXPECT_LT((difference - spline.rate(i, s)).norm(), 1e-7 * spline.rate(i, s).norm()) << s;
  }
}

/// Parabolic ends: any quadratic is reproduced, to the very ends, and with three samples only.
TEST(ImuSpline, ReproducesParabolas) {
  for (const int n : {3, 4, 9}) {
    ImuSignal imu;
    const auto parabola = [](double s) {
      return Vector6d(Vector6d::LinSpaced(6, 1.0, 2.0) * (1.0 - 3.0 * s + 7.0 * s * s));
    };
    for (int i = 0; i < n; ++i) {
      const double s = 0.1 * i + (i % 2 == 1 ? 0.03 : 0.0);
      imu.push_back(Time(from_seconds(s)), {parabola(s).head<3>(), parabola(s).tail<3>()});
    }
    const ImuSpline spline(imu, 1.0);
    for (double s = 0.0; s < spline.duration_s(); s += 0.0123) {
      EXPECT_LT((spline.value(*spline.interval(s), s) - parabola(s)).norm(), 1e-12) << n << " samples at " << s;
    }
  }
}

TEST(ImuSpline, KnowsWhereItIsDefined) {
  ImuSignal imu;
  for (const double s : {10.0, 10.1, 10.2, 10.3, 11.0, 12.0, 12.1}) imu.push_back(Time(from_seconds(s)), {});
  const ImuSpline spline(imu, 0.5);
  for (const double s : {-1e-9, 0.3 + 1e-9, 0.7, 1.0, 1.5, 2.1 + 1e-8}) EXPECT_FALSE(spline.interval(s)) << s;
  EXPECT_EQ(spline.interval(0.0), 0u);
  EXPECT_EQ(spline.interval(0.15), 1u);
  EXPECT_EQ(spline.interval(to_seconds(imu.time[3] - imu.time[0])), 2u);
  EXPECT_EQ(spline.interval(spline.duration_s()), 5u);
  EXPECT_TRUE(spline.covers(0.0, 0.25));
  EXPECT_FALSE(spline.covers(0.25, 2.05));
  EXPECT_FALSE(spline.covers(0.25, 0.35));
}

}  // namespace
}  // namespace vispline

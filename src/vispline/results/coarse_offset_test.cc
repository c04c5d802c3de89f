#include "vispline/results/coarse_offset.h"

#include <gtest/gtest.h>

#include <limits>

#include "vispline/results/imu_signal_testing.h"

namespace vispline {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr LagRange kAnyLag{-kInfinity, kInfinity};
constexpr double kMaxGap = 0.05;

/// Pearson correlation of |angular rate| at one lag, over the grid points where both signals are defined.
double correlation_at(const ImuSpline& first, const ImuSpline& second, double step_s, int lag) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;
  for (int i = 0; i * step_s <= first.duration_s(); ++i) {
    const double s = i * step_s, t = (i + lag) * step_s;
    if (!first.interval(s) || !second.interval(t)) continue;
    const double a = first.value(*first.interval(s), s).head<3>().norm();
    const double b = second.value(*second.interval(t), t).head<3>().norm();
    n += 1.0, x += a, y += b, xx += a * a, yy += b * b, xy += a * b;
  }
  return (xy / n - x * y / (n * n)) / std::sqrt((xx / n - x * x / (n * n)) * (yy / n - y * y / (n * n)));
}

TEST(CoarseOffset, CorrelationMatchesItsDefinitionAcrossGaps) {
  const TestMotion motion(31);
  const ImuSpline first(with_gap(observe(motion, {.rate_hz = 100.0, .end_s = 15.0, .clock_s = 2.0}), 4.0, 6.0),
                        kMaxGap);
  const ImuSpline second(with_gap(observe(motion, {.rate_hz = 100.0, .gyro_sigma = 0.1}), 9.0, 12.0), kMaxGap);
  const CoarseOffset found = *find_coarse_offset(first, second, 0.01, kAnyLag);
  EXPECT_NEAR(found.lag_s, 2.0, 0.005);
  EXPECT_NEAR(found.correlation, correlation_at(first, second, 0.01, 200), 1e-9);
  const int second_lag = static_cast<int>(std::lround(found.second_lag_s / 0.01));
  EXPECT_NEAR(found.second_correlation, correlation_at(first, second, 0.01, second_lag), 1e-9);
  EXPECT_LT(found.second_correlation, found.correlation);
}

TEST(CoarseOffset, FindsAShortPieceInALongRecord) {
  const TestMotion motion(32);
  const ImuSpline whole(observe(motion, {.end_s = 100.0}), kMaxGap);
  const ImuSpline piece(observe(motion, {.end_s = 10.0, .clock_s = 63.21}), kMaxGap);
  EXPECT_NEAR(find_coarse_offset(whole, piece, 0.005, kAnyLag)->lag_s, -63.21, 0.005);
  EXPECT_NEAR(find_coarse_offset(piece, whole, 0.005, kAnyLag)->lag_s, 63.21, 0.005);
}

TEST(CoarseOffset, HonoursTheRangeAndTheOverlap) {
  const TestMotion motion(33);
  const ImuSpline first(observe(motion, {.clock_s = 5.0}), kMaxGap), second(observe(motion, {}), kMaxGap);
  const CoarseOffset limited = *find_coarse_offset(first, second, 0.005, {-3.0, 2.0});
  EXPECT_GE(limited.lag_s, -3.0);
  EXPECT_LE(limited.lag_s, 2.0025);
  EXPECT_FALSE(find_coarse_offset(first, second, 0.005, {10.1, 30.0}));  // less than half would overlap
  EXPECT_TRUE(find_coarse_offset(first, second, 0.005, {9.9, 30.0}));
}

TEST(CoarseOffset, LongSignalsAreAveragedOntoACoarserGrid) {
  const TestMotion motion(34);
  const ImuSpline first(observe(motion, {.end_s = 100.0, .clock_s = 1.0}), kMaxGap);
  const ImuSpline second(observe(motion, {.end_s = 100.0}), kMaxGap);
  const CoarseOffset found = *find_coarse_offset(first, second, 0.005, kAnyLag, 2000);  // 20000 steps asked for
  EXPECT_NEAR(found.step_s, 0.05, 1e-4);
  EXPECT_NEAR(found.lag_s, 1.0, 5e-3);
}

TEST(CoarseOffset, ConstantRatesDoNotCorrelate) {
  const auto steady = [](double) { return ImuSample{Vector3d(0.3, 0.2, 0.1), Vector3d(0.0, 0.0, 9.81)}; };
  const ImuSpline first(observe(steady, {}), kMaxGap), second(observe(TestMotion(35), {}), kMaxGap);
  EXPECT_EQ(find_coarse_offset(first, second, 0.005, kAnyLag)->correlation, 0.0);
}

}  // namespace
}  // namespace vispline

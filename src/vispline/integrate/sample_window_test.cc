#include "vispline/integrate/sample_window.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vispline {
namespace {

/// A cubic in every component, a different one in each.
ImuSample cubic(double t) {
  const Vector3d gyro(1 - 2 * t + 3 * t * t - 0.5 * t * t * t, 4 * t * t * t, 2 + t);
  return {gyro, Vector3d(t * t - 7, 0.3 - t * t * t, 5 * t + 2 * t * t)};
}

ImuSignal irregular_cubic(std::size_t count) {
  constexpr double kStamps[] = {0.0, 0.11, 0.15, 0.34, 0.41, 0.60, 0.63};
  ImuSignal imu;
  for (std::size_t i = 0; i < count; ++i) {
    imu.push_back(time_from_ns(1'000'000'000'000'000'000) + from_seconds(kStamps[i]), cubic(kStamps[i]));
  }
  return imu;
}

double difference(const ImuSample& a, const ImuSample& b) {
  return (a.gyro - b.gyro).norm() + (a.accel - b.accel).norm();
}

TEST(SampleWindow, FourPointsReproduceACubicInsideAndAtBothEnds) {
  const ImuSignal imu = irregular_cubic(7);
  for (std::size_t i = 0; i + 1 < imu.size(); ++i) {
    const SampleWindow window(imu, i);
    for (const double u : {0.0, 0.2, 0.5, 0.9, 1.0}) {
      const double t = to_seconds(imu.time[i] - imu.time[0]) + u * window.dt();
      EXPECT_LT(difference(window.interpolate(u, 4), cubic(t)), 1e-13) << i << " " << u;
    }
  }
}

TEST(SampleWindow, TwoPointsAreLinearAndExactAtTheSamples) {
  const ImuSignal imu = irregular_cubic(5);
  const SampleWindow window(imu, 2);
  EXPECT_EQ(difference(window.interpolate(0.0, 2), imu.value[2]), 0.0);
  EXPECT_EQ(difference(window.interpolate(1.0, 4), imu.value[3]), 0.0);
  const ImuSample mean{0.5 * (imu.value[2].gyro + imu.value[3].gyro), 0.5 * (imu.value[2].accel + imu.value[3].accel)};
  EXPECT_LT(difference(window.interpolate(0.5, 2), mean), 1e-15);
}

TEST(SampleWindow, AShortSignalIsInterpolatedThroughAllItsSamples) {
  const ImuSignal two = irregular_cubic(2), three = irregular_cubic(3);
  EXPECT_LT(difference(SampleWindow(two, 0).interpolate(0.3, 4), SampleWindow(two, 0).interpolate(0.3, 2)), 1e-15);
  const ImuSample from_left = SampleWindow(three, 0).interpolate(1.0, 4);
  EXPECT_LT(difference(from_left, SampleWindow(three, 1).interpolate(0.0, 4)), 1e-15);
  EXPECT_GT(difference(SampleWindow(three, 0).interpolate(0.5, 4), SampleWindow(three, 0).interpolate(0.5, 2)), 1e-3);
}

TEST(SampleWindow, KnowsTheStepBefore) {
  const ImuSignal imu = irregular_cubic(4);
  EXPECT_FALSE(SampleWindow(imu, 0).previous());
  EXPECT_DOUBLE_EQ(SampleWindow(imu, 2).previous()->dt(), 0.04);
  EXPECT_DOUBLE_EQ(SampleWindow(imu, 2).dt(), 0.19);
}

}  // namespace
}  // namespace vispline

#include "vispline/simulate/axis_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace vispline {
namespace {

TEST(Digitise, RoundsAndSaturates) {
  const NoiseModel both{.quantum = 0.25, .range = 1.1};
  EXPECT_EQ(digitise(both, 0.3), 0.25);
  EXPECT_EQ(digitise(both, -0.38), -0.5);
  EXPECT_EQ(digitise(both, 0.375), 0.5);  // ties go to the even multiple
  EXPECT_EQ(digitise(both, 0.125), 0.0);
  EXPECT_EQ(digitise(both, 1.2), 1.0);  // the largest multiple within the range
  EXPECT_EQ(digitise(both, -1e9), -1.0);
  EXPECT_EQ(digitise({.range = 1.1}, 1.2), 1.1);
  EXPECT_EQ(digitise({.range = 1.1}, -0.3), -0.3);
  EXPECT_EQ(digitise({.quantum = 0.1, .range = 0.3}, 5.0), 0.1 * 3.0);  // although 0.3 / 0.1 < 3
  EXPECT_EQ(digitise({}, 0.123456789), 0.123456789);
}

TEST(Digitise, QuantisationErrorIsUniform) {
  // White noise of many quanta: the error of rounding has variance quantum^2 / 12.
  const NoiseModel model{.quantum = 0.01};
  const RandomStream stream(6, "signal");
  constexpr int kDraws = 100000;
  double sum = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = stream.normal(static_cast<std::uint64_t>(i));
    sum += std::pow(digitise(model, x) - x, 2);
  }
  const double relative_sigma = std::sqrt(0.8 / kDraws);  // of the square of a uniform number
  EXPECT_NEAR(sum / kDraws / (1e-4 / 12.0), 1.0, 6.0 * relative_sigma);
}

TEST(AxisNoise, NoNoiseIsExactBitForBit) {
  AxisNoise axis({}, 1, "axis");
  axis.advance(0, 1.0, 1.0);
  for (const double exact : {0.1, -0.0, 5e-324, -1e300}) {
    const double read = axis.read(exact, axis.bias(), axis.normals(3).white, 14.1);
    EXPECT_EQ(read, exact);
    EXPECT_EQ(std::signbit(read), std::signbit(exact));
  }
}

TEST(AxisNoise, WhiteNoiseHasVarianceN2Rate) {
  constexpr double kN = 0.015, kRate_hz = 200.0;
  constexpr std::uint64_t kDraws = 200000;
  const AxisNoise axis({.white = kN}, 2, "white");
  double sum = 0.0, square = 0.0;
  for (std::uint64_t i = 0; i < kDraws; ++i) {
    const double error = axis.read(0.0, 0.0, axis.normals(i).white, std::sqrt(kRate_hz));
    sum += error;
    square += error * error;
  }
  const double variance = kN * kN * kRate_hz;  // 0.212 rad/s squared
  EXPECT_NEAR(sum / kDraws, 0.0, 6.0 * std::sqrt(variance / kDraws));
  EXPECT_NEAR(square / kDraws / variance, 1.0, 6.0 * std::sqrt(2.0 / kDraws));
}

TEST(AxisNoise, RandomWalkVarianceGrowsAsK2T) {
  constexpr double kK = 5e-5, kStep = 0.005;
  constexpr std::uint64_t kRuns = 3000, kSteps = 400;
  std::vector<double> square(3, 0.0);
  for (std::uint64_t run = 0; run < kRuns; ++run) {
    AxisNoise axis({.walk = kK}, run, "walk");
    EXPECT_EQ(axis.bias(), 0.0);
    for (std::uint64_t i = 0; i < kSteps; ++i) {
      axis.advance(i, axis.normals(i).walk, kStep);
      if (i == 0) square[0] += std::pow(axis.bias(), 2);
      if (i == kSteps / 4 - 1) square[1] += std::pow(axis.bias(), 2);
      if (i == kSteps - 1) square[2] += std::pow(axis.bias(), 2);
    }
  }
  const double times[] = {kStep, kSteps / 4 * kStep, kSteps * kStep};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(square[k] / kRuns / (kK * kK * times[k]), 1.0, 6.0 * std::sqrt(2.0 / kRuns)) << times[k];
  }
}

TEST(AxisNoise, TurnOnBiasIsDrawnOnce) {
  constexpr std::uint64_t kRuns = 20000;
  double square = 0.0;
  for (std::uint64_t seed = 0; seed < kRuns; ++seed) {
    AxisNoise axis({.turn_on_bias = 0.3}, seed, "axis");
    const double at_start = axis.bias();
    axis.advance(0, axis.normals(0).walk, 100.0);
    ASSERT_EQ(axis.bias(), at_start);
    square += at_start * at_start;
  }
  EXPECT_NEAR(square / kRuns / 0.09, 1.0, 6.0 * std::sqrt(2.0 / kRuns));
}

TEST(AxisNoise, OneNoiseDoesNotChangeTheDrawsOfAnother) {
  const AxisNoise white({.white = 1.0}, 4, "axis"),
      all({.white = 2.0, .walk = 1.0, .bias_instability = 1.0}, 4, "axis");
  EXPECT_EQ(white.normals(11).white, all.normals(11).white);
  EXPECT_NE(all.normals(11).white, all.normals(11).walk);
}

}  // namespace
}  // namespace vispline

#include "vispline/allan/analysis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "vispline/allan/factors.h"
#include "vispline/allan/stream_curve.h"

namespace vispline {
namespace {

/// White noise N and random walk K at this rate.
std::vector<double> noise(double white, double walk, double rate_hz, double seconds, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  std::vector<double> readings(static_cast<std::size_t>(seconds * rate_hz));
  double bias = 0.3;
  for (double& reading : readings) {
    reading = bias + white * std::sqrt(rate_hz) * normal(engine);
    bias += walk / std::sqrt(rate_hz) * normal(engine);
  }
  return readings;
}

AllanResult analyzed(const std::vector<double>& readings, double rate_hz, AllanOptions options = {},
                     std::size_t block = 1000) {
  AllanAnalyzer analyzer({{"gyroscope", "x", "rad/s"}}, std::move(options));
  for (std::size_t i = 0; i < readings.size(); i += block) {
    const std::span<const double> part = std::span(readings).subspan(i, std::min(block, readings.size() - i));
    analyzer.push({&part, 1});
  }
  return analyzer.finish(rate_hz);
}

TEST(Analysis, FindsWhiteNoiseAndRandomWalk) {
  int white_inside = 0, walk_inside = 0;
  constexpr int kRuns = 20;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    const AllanResult result = analyzed(noise(0.01, 3e-4, 100.0, 3600.0, seed), 100.0);
    const NoiseTerms& terms = result.signals[0].terms;
    ASSERT_TRUE(terms[Term::kWhite].resolved);
    ASSERT_TRUE(terms[Term::kRandomWalk].resolved) << seed;
    EXPECT_NEAR(terms[Term::kWhite].value / 0.01, 1.0, 0.01);
    EXPECT_NEAR(terms[Term::kRandomWalk].value / 3e-4, 1.0, 0.6);
    white_inside += terms[Term::kWhite].low_95 < 0.01 && 0.01 < terms[Term::kWhite].high_95;
    walk_inside += terms[Term::kRandomWalk].low_95 < 3e-4 && 3e-4 < terms[Term::kRandomWalk].high_95;
    EXPECT_FALSE(terms[Term::kQuantization].resolved && terms[Term::kQuantization].significance > 20.0);
  }
  EXPECT_GE(white_inside, 16);  // of 20 at 95 %: fewer than 16 is a chance of 1 in 400
  EXPECT_GE(walk_inside, 16);
}

TEST(Analysis, WhatARecordCannotShowIsABound) {
  const AllanResult result = analyzed(noise(0.03, 1e-5, 200.0, 3600.0, 3), 200.0);
  const TermEstimate& walk = result.signals[0].terms[Term::kRandomWalk];
  EXPECT_FALSE(walk.resolved);
  EXPECT_EQ(walk.value, 0.0);
  ASSERT_TRUE(walk.upper_bound.has_value());
  EXPECT_GT(*walk.upper_bound, 1e-5);
  EXPECT_LT(*walk.upper_bound, 1e-3);
  ASSERT_TRUE(walk.record_needed_s.has_value());
  EXPECT_GT(*walk.record_needed_s, 3600.0);
}

TEST(Analysis, RampAndQuantizationAlone) {
  constexpr double kRate = 50.0;
  std::vector<double> ramp = noise(0.01, 0.0, kRate, 3600.0, 5);
  for (std::size_t i = 0; i < ramp.size(); ++i) ramp[i] += 2e-6 * static_cast<double>(i) / kRate;
  const NoiseTerms with_ramp = analyzed(ramp, kRate).signals[0].terms;
  EXPECT_TRUE(with_ramp[Term::kRamp].resolved || with_ramp[Term::kRandomWalk].resolved);

  std::vector<double> angle = noise(1.0, 0.0, 1.0, 360000.0, 6), quantized;
  for (std::size_t i = 1; i < angle.size(); ++i) quantized.push_back((angle[i] - angle[i - 1]) * 1e-4 * kRate);
  const NoiseTerms with_steps = analyzed(quantized, kRate).signals[0].terms;
  ASSERT_TRUE(with_steps[Term::kQuantization].resolved);
  EXPECT_NEAR(with_steps[Term::kQuantization].value / 1e-4, 1.0, 0.01);
}

/// N. Kasdin, Discrete simulation of colored noise, Proc. IEEE 83 (1995): white noise of deviation B through the filter
/// (1 - 1/z)^(-1/2) has the density B^2 / (2 pi f).
TEST(Analysis, FindsFlicker) {
  const std::vector<double> white = noise(1.0, 0.0, 1.0, 20000.0, 13);
  std::vector<double> filter{1.0}, readings = noise(2e-4, 0.0, 50.0, 400.0, 14);
  for (std::size_t k = 1; k < white.size(); ++k) {
    filter.push_back(filter.back() * (static_cast<double>(k) - 0.5) / static_cast<double>(k));
  }
  for (std::size_t i = 0; i < white.size(); ++i) {
    double sum = 0.0;
    for (std::size_t k = 0; k <= i; ++k) sum += filter[k] * (white[i - k] - 0.3);
    readings[i] += 1e-3 * sum;
  }
  const NoiseTerms terms = analyzed(readings, 50.0).signals[0].terms;
  ASSERT_TRUE(terms[Term::kFlicker].resolved);
  EXPECT_NEAR(terms[Term::kFlicker].value / 1e-3, 1.0, 0.1);
  EXPECT_FALSE(terms[Term::kRandomWalk].resolved);
}

TEST(Analysis, BandsOfTheCurveHoldTheTruthAsOftenAsTheySay) {
  constexpr int kRuns = 400;
  AllanOptions options;
  options.identify = false;  // white noise is assumed, and true
  options.taus = "octave";
  std::vector<int> inside;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    const AllanCurve curve = analyzed(noise(0.01, 0.0, 1.0, 1000.0, seed), 1.0, options).signals[0].curves[0];
    inside.resize(curve.tau_s.size(), 0);
    for (std::size_t i = 0; i < curve.tau_s.size(); ++i) {
      const double truth = 0.01 / std::sqrt(curve.tau_s[i]);
      inside[i] += curve.low[i] <= truth && truth <= curve.high[i];
    }
  }
  ASSERT_GE(inside.size(), 7u);
  // Of 400 at 68.3 %: 273, standard deviation 9.3; three of them either way. Beyond a fifteenth of the record the sum
  // is no chi-square any more and the bands are wider than they say.
  for (std::size_t i = 0; i < 7; ++i) EXPECT_NEAR(inside[i], 273, 28) << "tau " << (1 << i);
}

TEST(Analysis, SameForAnyBlockAndThreads) {
  const std::vector<double> readings = noise(0.01, 1e-4, 100.0, 1000.0, 7);
  for (const AllanMemory memory : {AllanMemory::kExact, AllanMemory::kBounded}) {
    AllanOptions options;
    options.memory = memory;
    const AllanResult one = analyzed(readings, 100.0, options, 97);
    options.threads = 2;
    const AllanResult two = analyzed(readings, 100.0, options, 50000);
    EXPECT_EQ(one.signals[0].curves[0].value, two.signals[0].curves[0].value);
    EXPECT_EQ(one.signals[0].terms[Term::kWhite].value, two.signals[0].terms[Term::kWhite].value);
  }
}

TEST(Analysis, BoundedMemoryIsCloseToExact) {
  const std::vector<double> readings = noise(0.01, 3e-4, 100.0, 4000.0, 8);
  AllanOptions bounded;
  bounded.memory = AllanMemory::kBounded;
  const AllanCurve exact = analyzed(readings, 100.0).signals[0].curves[0];
  const AllanCurve streamed = analyzed(readings, 100.0, bounded).signals[0].curves[0];
  ASSERT_FALSE(streamed.exact);
  ASSERT_GE(streamed.tau_s.size() + 1, exact.tau_s.size());
  for (std::size_t i = 0; i < std::min(streamed.tau_s.size(), exact.tau_s.size()); ++i) {
    ASSERT_DOUBLE_EQ(streamed.tau_s[i], exact.tau_s[i]);
    const double half_width = 0.5 * (exact.high[i] - exact.low[i]);
    // The same differences below 64 samples; above, a small part of the point's own uncertainty.
    const double limit = streamed.tau_s[i] * 100.0 < 63.5 ? 1e-9 * exact.value[i] : 0.15 * half_width;
    EXPECT_NEAR(streamed.value[i], exact.value[i], limit) << streamed.tau_s[i];
  }
}

TEST(StreamCurve, SegmentsArePooledNotBridged) {
  const std::vector<double> readings = noise(0.01, 0.0, 1.0, 5000.0, 9);
  StreamCurve whole(0.0), parts(0.0);
  whole.push(readings);
  whole.end_segment();
  parts.push(std::span(readings).first(2000));
  parts.end_segment();
  parts.push(std::span(readings).subspan(2000));
  parts.end_segment();
  EXPECT_EQ(whole.points()[0].sum.count, 4999);
  EXPECT_EQ(parts.points()[0].sum.count, 4998);
}

TEST(Analysis, AGapDoesNotBridge) {
  std::vector<double> readings = noise(0.01, 0.0, 100.0, 200.0, 10);
  for (std::size_t i = 10000; i < readings.size(); ++i) readings[i] += 5.0;  // another bias after the gap
  AllanAnalyzer analyzer({{"gyroscope", "x", "rad/s"}}, {});
  const std::span<const double> first = std::span(readings).first(10000), second = std::span(readings).subspan(10000);
  analyzer.push({&first, 1});
  analyzer.cut();
  analyzer.push({&second, 1});
  const AllanResult result = analyzer.finish(100.0);
  EXPECT_EQ(result.segments, 2);
  for (const double value : result.signals[0].curves[0].value) EXPECT_LT(value, 0.2);
}

TEST(Analysis, RefusesWhatIsTooShortOrConstant) {
  EXPECT_THROW(analyzed(std::vector<double>(50, 1.0), 100.0), Error);
  EXPECT_THROW(analyzed(std::vector<double>(500, 1.0), 100.0), Error);
}

TEST(Analysis, ADeadAxisHasNoNumbers) {
  const std::vector<double> alive = noise(0.01, 0.0, 100.0, 60.0, 15), dead(alive.size(), 0.25);
  AllanAnalyzer analyzer({{"gyroscope", "x", "rad/s"}, {"gyroscope", "y", "rad/s"}}, {});
  const std::span<const double> axes[] = {alive, dead};
  analyzer.push(axes);
  const AllanResult result = analyzer.finish(100.0);
  EXPECT_TRUE(result.signals[0].terms[Term::kWhite].resolved);
  EXPECT_TRUE(result.signals[1].constant);
  EXPECT_TRUE(result.signals[1].curves.empty());
  EXPECT_FALSE(result.signals[1].terms[Term::kWhite].resolved);
  EXPECT_EQ(result.signals[1].mean, 0.25);
}

TEST(Analysis, ImuUtilsNumbersAreTheCrossover) {
  // Theory: n = N sqrt(rate), w = sqrt(2 N K / sqrt 3).
  const double white = 0.01, walk = 1e-4;
  double n = 0.0, w = 0.0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const auto numbers = analyzed(noise(white, walk, 50.0, 14400.0, seed), 50.0).signals[0].imu_utils;
    n += 0.25 * numbers.n;
    w += 0.25 * numbers.w;
  }
  EXPECT_NEAR(n / (white * std::sqrt(50.0)), 1.0, 0.03);
  EXPECT_NEAR(w / std::sqrt(2.0 * white * walk / std::sqrt(3.0)), 1.0, 0.15);
}

std::int64_t count_of(const Diagnostics& found, const std::string& code) {
  const auto at = found.counts().find(code);
  return at == found.counts().end() ? 0 : at->second;
}

TEST(Checks, QuietRecordHasNoWarning) {
  EXPECT_TRUE(analyzed(noise(0.01, 1e-5, 100.0, 600.0, 11), 100.0).diagnostics.empty());
}

TEST(Checks, MotionSpikesDriftStepsAndHeldReadings) {
  const std::vector<double> still = noise(0.01, 0.0, 100.0, 600.0, 12);
  std::vector<double> moved = still, spiked = still, drifting = still, stepped = still, repeated = still;
  for (std::size_t i = 20000; i < 21000; ++i) moved[i] += 2.0 * std::sin(0.1 * static_cast<double>(i));
  spiked[30000] += 50.0;
  for (std::size_t i = 0; i < still.size(); ++i) {
    drifting[i] += 0.5 * (1.0 - std::exp(-static_cast<double>(i) / 20000.0));
    stepped[i] = 0.2 * std::round(still[i] / 0.2);
    repeated[i] = still[i - i % 4];
  }
  EXPECT_EQ(count_of(analyzed(moved, 100.0).diagnostics, "W-MOTION"), 1);
  EXPECT_EQ(count_of(analyzed(spiked, 100.0).diagnostics, "W-SPIKE"), 1);
  EXPECT_EQ(count_of(analyzed(drifting, 100.0).diagnostics, "W-DRIFT"), 1);
  EXPECT_EQ(count_of(analyzed(stepped, 100.0).diagnostics, "W-QUANTUM"), 1);
  EXPECT_EQ(count_of(analyzed(repeated, 100.0).diagnostics, "W-HELD"), 1);
}

}  // namespace
}  // namespace vispline

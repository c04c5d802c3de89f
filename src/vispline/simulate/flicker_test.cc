#include "vispline/simulate/flicker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace vispline {
namespace {

const double kFloor = std::sqrt(2.0 * std::numbers::ln2 / std::numbers::pi);  // 0.664, for B = 1

/// Allan variance of a Gauss-Markov process of variance 1 and time constant T at averaging time tau.
double gauss_markov_avar(double tau, double T) {
  const double x = tau / T;
  if (x < 1e-3) return 2.0 * x / 3.0;  // the next term is x^2 / 2
  return 2.0 / x * (1.0 - (3.0 - 4.0 * std::exp(-x) + std::exp(-2.0 * x)) / (2.0 * x));
}

/// Overlapping Allan variance of samples x dt apart, averaged over m samples.
double overlapping_avar(const std::vector<double>& x, std::size_t m) {
  std::vector<double> phase(x.size() + 1, 0.0);
  for (std::size_t i = 0; i < x.size(); ++i) phase[i + 1] = phase[i] + x[i];
  double sum = 0.0;
  const std::size_t terms = x.size() + 1 - 2 * m;
  for (std::size_t i = 0; i < terms; ++i) sum += std::pow(phase[i + 2 * m] - 2.0 * phase[i + m] + phase[i], 2);
  return sum / (2.0 * static_cast<double>(m * m * terms));
}

TEST(Flicker, TheSumOfTheTermsHasAFlatFloor) {
  EXPECT_NEAR(kFloor, 0.664, 5e-4);
  for (double tau = 1.0; tau <= 1e5; tau *= 1.1) {
    double variance = 0.0;
    for (const double T : FlickerProcess::time_constants()) variance += gauss_markov_avar(tau, T);
    const double ratio = FlickerProcess::unit_sigma() * std::sqrt(variance) / kFloor;
    EXPECT_GT(ratio, 0.975) << tau;
    EXPECT_LT(ratio, 1.011) << tau;
  }
}

TEST(Flicker, SamplesHaveTheFloor) {
  constexpr double kB = 3e-3, kStep = 0.1;
  constexpr std::size_t kRuns = 8, kSamples = 131072;
  const std::size_t averaged[] = {20, 100, 1000};
  double variance[3] = {};
  for (std::size_t run = 0; run < kRuns; ++run) {
    FlickerProcess process(kB, 5, "run" + std::to_string(run));
    std::vector<double> x(kSamples);
    for (std::size_t i = 0; i < kSamples; ++i) {
      x[i] = process.value();
      process.advance(i, kStep);
    }
    for (std::size_t k = 0; k < 3; ++k) variance[k] += overlapping_avar(x, averaged[k]) / kRuns;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const double degrees_of_freedom = static_cast<double>(kRuns * kSamples / averaged[k]);
    const double tolerance = 0.025 + 6.0 / std::sqrt(2.0 * degrees_of_freedom);
    EXPECT_NEAR(std::sqrt(variance[k]) / (kB * kFloor), 1.0, tolerance) << averaged[k];
  }
}

TEST(Flicker, IsStationaryFromTheFirstSampleWhateverTheStep) {
  constexpr std::size_t kRuns = 4000;
  double first = 0.0, later = 0.0;
  for (std::size_t run = 0; run < kRuns; ++run) {
    FlickerProcess process(1.0, run, "start");
    first += std::pow(process.value(), 2);
    process.advance(0, 0.01);
    process.advance(1, 1e4);
    later += std::pow(process.value(), 2);
  }
  const double variance = 8.0 * std::numbers::ln10 / std::numbers::pi;
  const double tolerance = 6.0 * std::sqrt(2.0 / kRuns);
  EXPECT_NEAR(first / kRuns / variance, 1.0, tolerance);
  EXPECT_NEAR(later / kRuns / variance, 1.0, tolerance);
}

TEST(Flicker, NoneIsExactlyZero) {
  FlickerProcess process(0.0, 1, "none");
  process.advance(0, 1.0);
  EXPECT_EQ(process.value(), 0.0);
}

}  // namespace
}  // namespace vispline

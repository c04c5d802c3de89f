#include "vispline/allan/deviation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "vispline/allan/factors.h"
#include "vispline/allan/nbs14_testing.h"
#include "vispline/allan/overlapping.h"

namespace vispline {
namespace {

double value_of(Deviation kind, std::span<const double> phase, std::int64_t m) {
  return deviation(kind, squared_sum(kind, phase, m), m, 1.0);
}

struct Published {
  Deviation kind;
  std::int64_t m;
  double value;
};

TEST(Deviation, Nbs14ThousandPoints) {
  const Phase phase = testing::nbs14_phase();
  const Published table[] = {
      {Deviation::kAdev, 1, 2.922319e-1},    {Deviation::kAdev, 10, 9.965736e-2},
      {Deviation::kAdev, 100, 3.897804e-2},  {Deviation::kOadev, 1, 2.922319e-1},
      {Deviation::kOadev, 10, 9.159953e-2},  {Deviation::kOadev, 100, 3.241343e-2},
      {Deviation::kMdev, 1, 2.922319e-1},    {Deviation::kMdev, 10, 6.172376e-2},
      {Deviation::kMdev, 100, 2.170921e-2},  {Deviation::kTotdev, 1, 2.922319e-1},
      {Deviation::kTotdev, 10, 9.134743e-2}, {Deviation::kTotdev, 100, 3.406530e-2},
      {Deviation::kHdev, 1, 2.943883e-1},    {Deviation::kHdev, 10, 1.052754e-1},
      {Deviation::kHdev, 100, 3.910860e-2},  {Deviation::kOhdev, 1, 2.943883e-1},
      {Deviation::kOhdev, 10, 9.581083e-2},  {Deviation::kOhdev, 100, 3.237638e-2},
      {Deviation::kTdev, 1, 1.687202e-1},    {Deviation::kTdev, 10, 3.563623e-1},
      {Deviation::kTdev, 100, 1.253382},     {Deviation::kOadev, 2, 2.010160e-1},
      {Deviation::kOadev, 16, 6.191478e-2},  {Deviation::kOadev, 256, 1.028222e-2},
      {Deviation::kAdev, 4, 1.494271e-1},    {Deviation::kAdev, 128, 3.385520e-2},
  };
  for (const auto& [kind, m, expected] : table) {
    EXPECT_NEAR(value_of(kind, phase, m) / expected, 1.0, 3e-7) << name_of(kind) << " at " << m;
  }
}

TEST(Deviation, Nbs14TenPoints) {
  const std::vector<double> y{892, 809, 823, 798, 671, 644, 883, 903, 677};
  const Phase phase = phase_of(y, 1.0, 0.0);
  const Published table[] = {
      {Deviation::kAdev, 1, 91.22945}, {Deviation::kAdev, 2, 115.8082},   {Deviation::kOadev, 2, 85.95287},
      {Deviation::kMdev, 2, 74.78849}, {Deviation::kTotdev, 1, 91.22945}, {Deviation::kTotdev, 2, 93.90379},
      {Deviation::kHdev, 1, 70.80608}, {Deviation::kHdev, 2, 116.7980},   {Deviation::kOhdev, 2, 85.61487},
      {Deviation::kTdev, 1, 52.67135}, {Deviation::kTdev, 2, 86.35831},
  };
  for (const auto& [kind, m, expected] : table) {
    EXPECT_NEAR(value_of(kind, phase, m) / expected, 1.0, 2e-7) << name_of(kind) << " at " << m;
  }
}

TEST(Deviation, CountsOfTheNistTable) {
  const Phase phase = testing::nbs14_phase();
  EXPECT_EQ(squared_sum(Deviation::kAdev, phase, 10).count, 99);
  EXPECT_EQ(squared_sum(Deviation::kOadev, phase, 10).count, 981);
  EXPECT_EQ(squared_sum(Deviation::kOadev, phase, 100).count, 801);
  EXPECT_EQ(squared_sum(Deviation::kTotdev, phase, 100).count, 999);
}

TEST(Deviation, TooShortHasNoValue) {
  const std::vector<double> phase{0.0, 1.0, 3.0};
  for (const std::string& name : deviation_names()) {
    const Deviation kind = *deviation_named(name);
    for (std::int64_t m = 1; m < 8; ++m) {
      const bool fits = points_needed(kind, m) <= 3;
      EXPECT_EQ(squared_sum(kind, phase, m).count > 0, fits) << name << " at " << m;
    }
  }
}

TEST(OverlappingSums, EqualOnePassPerFactorForAnyThreads) {
  std::vector<double> first, second;
  for (int k = 0; k < 200001; ++k) {
    first.push_back(std::sin(0.7 * k) + 1e-3 * k);
    second.push_back(std::cos(1.3 * k * k));
  }
  const std::vector<std::span<const double>> series{first, second};
  const auto factors = averaging_factors("log", 200000, Deviation::kOadev);
  const auto one = overlapping_sums(series, factors, 1);
  const auto two = overlapping_sums(series, factors, 3);
  for (std::size_t s = 0; s < 2; ++s) {
    for (std::size_t i = 0; i < factors.size(); ++i) {
      const SquaredSum expected = squared_sum(Deviation::kOadev, series[s], factors[i]);
      EXPECT_EQ(one[s][i].count, expected.count);
      EXPECT_NEAR(one[s][i].sum / expected.sum, 1.0, 1e-11) << factors[i];
      EXPECT_EQ(one[s][i].sum, two[s][i].sum);
    }
  }
}

TEST(Factors, GridsGrowToTheLastThatFits) {
  for (const char* grid : {"log", "octave", "decade", "100"}) {
    const auto factors = averaging_factors(grid, 1000, Deviation::kOadev);
    EXPECT_EQ(factors.front(), 1) << grid;
    EXPECT_LE(factors.back(), 500) << grid;
    EXPECT_GT(factors.back(), 200) << grid;
    for (std::size_t i = 1; i < factors.size(); ++i) EXPECT_LT(factors[i - 1], factors[i]) << grid;
  }
  EXPECT_EQ(averaging_factors("all", 1000, Deviation::kOadev).size(), 500u);
  EXPECT_EQ(averaging_factors("100", 1000, Deviation::kOadev).back(), 500);
  EXPECT_EQ(averaging_factors("log", 2160000, Deviation::kOadev).size(), 93u);
}

}  // namespace
}  // namespace vispline

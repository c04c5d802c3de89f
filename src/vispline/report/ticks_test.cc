#include "vispline/report/ticks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "vispline/report/number.h"

namespace vispline::report {
namespace {

std::vector<std::string> labels(const Ticks& ticks) {
  std::vector<std::string> out;
  for (const Tick& t : ticks.major) {
    out.push_back(t.label.text + (t.label.exponent ? joined({"^", std::to_string(*t.label.exponent)}) : ""));
  }
  return out;
}

/// What a label says, as a number.
double meaning(const TickLabel& label) {
  std::string text = label.text;
  const bool negative = text.starts_with("−");
  if (negative) text.erase(0, std::string("−").size());
  const std::size_t times = text.find("×10");
  if (times != std::string::npos) text.erase(times);
  const bool bare_power = label.exponent && times == std::string::npos;
  const double factor = (negative ? -1.0 : 1.0) * (label.exponent ? power_of_ten(*label.exponent) : 1.0);
  return bare_power ? factor : factor * std::stod(text);
}

void expect_laws(const Ticks& ticks, Range range, std::size_t least) {
  ASSERT_GE(ticks.major.size(), least) << range.lo << " " << range.hi;
  ASSERT_LE(ticks.major.size(), 9U) << range.lo << " " << range.hi;
  const double length = range.hi - range.lo;
  for (std::size_t i = 0; i < ticks.major.size(); ++i) {
    const double value = ticks.major[i].value;
    EXPECT_GE(value, range.lo);
    EXPECT_LE(value, range.hi);
    EXPECT_TRUE(i == 0 || value > ticks.major[i - 1].value);
    EXPECT_NEAR(meaning(ticks.major[i].label), value, 1e-9 * std::max(length, std::abs(value)));
  }
  for (const double value : ticks.minor) EXPECT_TRUE(value >= range.lo && value <= range.hi);
}

TEST(LinearTicks, LawsOnRandomRanges) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 20000; ++i) {
    const double length = std::pow(10.0, 12.0 * unit(generator));
    const double lo = length * std::pow(10.0, 1.5 + 1.5 * unit(generator)) * unit(generator);
    const Range range{lo, lo + length};
    const Ticks ticks = linear_ticks(range, 4 + i % 6);
    expect_laws(ticks, range, 4);
    for (std::size_t k = 2; k < ticks.major.size(); ++k) {
      const double step = ticks.major[1].value - ticks.major[0].value;
      EXPECT_NEAR(ticks.major[k].value - ticks.major[k - 1].value, step, 1e-9 * step + 1e-14 * std::abs(lo));
    }
  }
}

TEST(LinearTicks, LabelsHaveTheDecimalsOfTheStep) {
  EXPECT_EQ(labels(linear_ticks({0.0, 20.0}, 5)), (std::vector<std::string>{"0", "5", "10", "15", "20"}));
  EXPECT_EQ(labels(linear_ticks({-0.21, 0.21}, 5)), (std::vector<std::string>{"−0.2", "−0.1", "0.0", "0.1", "0.2"}));
  EXPECT_EQ(labels(linear_ticks({0.0, 4e-7}, 5)),
            (std::vector<std::string>{"0", "1×10^-7", "2×10^-7", "3×10^-7", "4×10^-7"}));
  EXPECT_EQ(labels(linear_ticks({5.5, 24.5}, 6)).at(0), "7.5");  // neither steps of 2 nor of 5 give 4 to 9
  EXPECT_EQ(labels(linear_ticks({0.0, 2e6}, 5)).back(), "2.0×10^6");
}

TEST(LinearTicks, ExtremeRanges) {
  for (const Range range : {Range{-1e300, 1e300}, Range{0.0, 1e-280}, Range{1e300, 1.1e300}, Range{1.0, 1.0 + 2e-12}}) {
    const Ticks ticks = linear_ticks(range, 5);
    EXPECT_GE(ticks.major.size(), 4U);
    EXPECT_LE(ticks.major.size(), 9U);
  }
}

TEST(LogTicks, LawsOnRandomRanges) {
  std::mt19937 generator(4);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 20000; ++i) {
    const double lo = std::pow(10.0, 20.0 * unit(generator) - 12.0);
    const double hi = lo * std::pow(10.0, 1e-3 + (i % 2 == 0 ? 2.0 : 30.0) * unit(generator));
    expect_laws(log_ticks({lo, hi}), {lo, hi}, 3);
  }
}

TEST(LogTicks, EveryDecadeHasItsOwnExponent) {
  EXPECT_EQ(labels(log_ticks({5e-8, 3.0})),
            (std::vector<std::string>{"10^-7", "10^-6", "10^-5", "10^-4", "10^-3", "10^-2", "10^-1", "10^0"}));
  EXPECT_EQ(labels(log_ticks({1e-12, 1e3})),
            (std::vector<std::string>{"10^-12", "10^-10", "10^-8", "10^-6", "10^-4", "10^-2", "10^0", "10^2"}));
}

TEST(LogTicks, FewDecadesAreMarkedInside) {
  EXPECT_EQ(labels(log_ticks({45.0, 1100.0})), (std::vector<std::string>{"50", "100", "200", "500", "1000"}));
  EXPECT_EQ(labels(log_ticks({1.5e-5, 6e-5})),
            (std::vector<std::string>{"2×10^-5", "3×10^-5", "4×10^-5", "5×10^-5", "6×10^-5"}));
  const Ticks minor = log_ticks({1.0, 1000.0});
  EXPECT_EQ(minor.major.size(), 4U);
  EXPECT_EQ(minor.minor.size(), 24U);  // 2 to 9 in three decades
}

TEST(Number, SignificantDigitsOfATableCell) {
  EXPECT_EQ(significant(0.57656, 4), "0.5766");
  EXPECT_EQ(significant(0.001286, 4), "0.001286");
  EXPECT_EQ(significant(1.2858e-7, 4), "1.286e-7");
  EXPECT_EQ(significant(-1e22, 3), "-1.00e22");
  EXPECT_EQ(significant(9.9996, 4), "10.00");
  EXPECT_EQ(significant(200.0, 4), "200.0");
  EXPECT_EQ(significant(123456.7, 4), "123457");
  EXPECT_EQ(significant(0.0, 4), "0");
  for (const double value : {std::nan(""), HUGE_VAL, -HUGE_VAL}) EXPECT_EQ(significant(value, 4), "—");
  EXPECT_EQ(significant(std::numeric_limits<double>::denorm_min(), 2), "4.9e-324");
}

TEST(Number, CoordinatesAreShort) {
  EXPECT_EQ(coordinate(1.0), "1");
  EXPECT_EQ(coordinate(-0.001), "0");
  EXPECT_EQ(coordinate(100.0), "100");
  EXPECT_EQ(coordinate(2.506), "2.51");
  EXPECT_EQ(coordinate(-2.5), "-2.5");
}

TEST(Number, ExponentOfPowersOfTen) {
  for (int n = -307; n <= 308; ++n) EXPECT_EQ(decimal_exponent(power_of_ten(n)), n);
  EXPECT_EQ(decimal_exponent(-999.9), 2);
}

}  // namespace
}  // namespace vispline::report

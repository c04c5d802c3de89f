#include "vispline/io/number_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "vispline/core/random.h"
#include "vispline/io/time_unit.h"

namespace vispline {
namespace {

TEST(Decimal, IsExactWhereADoubleIsNot) {
  Decimal d;
  ASSERT_EQ(parse_decimal("1520530308.181901469", d), NumberStatus::kOk);
  EXPECT_EQ(to_nanoseconds(d, parse_time_unit("s")), 1520530308181901469);
  ASSERT_EQ(parse_decimal("1520530308181901469", d), NumberStatus::kOk);
  EXPECT_EQ(to_nanoseconds(d, parse_time_unit("ns")), 1520530308181901469);
  ASSERT_EQ(parse_decimal("1520530308181.901469", d), NumberStatus::kOk);
  EXPECT_EQ(to_nanoseconds(d, parse_time_unit("ms")), 1520530308181901469);
  ASSERT_EQ(parse_decimal("1520530308181901.469", d), NumberStatus::kOk);
  EXPECT_EQ(to_nanoseconds(d, parse_time_unit("us")), 1520530308181901469);
}

struct Case {
  const char* text;
  NumberStatus status;
  std::int64_t ns;  ///< read as seconds
};

TEST(Decimal, Table) {
  for (const Case& c : {Case{"0", NumberStatus::kOk, 0},
                        Case{".5", NumberStatus::kOk, 500'000'000},
                        Case{"5.", NumberStatus::kOk, 5'000'000'000},
                        Case{"+1", NumberStatus::kOk, 1'000'000'000},
                        Case{"-0.25", NumberStatus::kOk, -250'000'000},
                        Case{"-3", NumberStatus::kOk, -3'000'000'000},
                        Case{"0.9999999996", NumberStatus::kOk, 1'000'000'000},
                        Case{"0.0000000004", NumberStatus::kOk, 0},
                        Case{"1.5e3", NumberStatus::kOk, 1'500'000'000'000},
                        Case{"15E-1", NumberStatus::kOk, 1'500'000'000},
                        Case{"1e-3", NumberStatus::kOk, 1'000'000},
                        Case{"-2.9840000e-02", NumberStatus::kOk, -29'840'000},
                        Case{"0e500", NumberStatus::kOk, 0},
                        Case{"1e-500", NumberStatus::kOk, 0},
                        Case{"1e400", NumberStatus::kOutOfRange, 0},
                        Case{"99999999999999999999", NumberStatus::kOutOfRange, 0},
                        Case{"nan", NumberStatus::kNotFinite, 0},
                        Case{"-Inf", NumberStatus::kNotFinite, 0},
                        Case{"", NumberStatus::kNotNumber, 0},
                        Case{"-", NumberStatus::kNotNumber, 0},
                        Case{".", NumberStatus::kNotNumber, 0},
                        Case{"1.2.3", NumberStatus::kNotNumber, 0},
                        Case{"1e", NumberStatus::kNotNumber, 0},
                        Case{"1,5", NumberStatus::kNotNumber, 0},
                        Case{"0x10", NumberStatus::kNotNumber, 0},
                        Case{"12ab", NumberStatus::kNotNumber, 0}}) {
    Decimal d;
    EXPECT_EQ(parse_decimal(c.text, d), c.status) << c.text;
    if (c.status != NumberStatus::kOk) continue;
    EXPECT_EQ(to_nanoseconds(d, TimeUnit{}), c.ns) << c.text;
  }
}

TEST(Decimal, BeyondInt64NanosecondsIsNoTime) {
  Decimal d;
  ASSERT_EQ(parse_decimal("9223372037", d), NumberStatus::kOk);
  EXPECT_EQ(to_nanoseconds(d, TimeUnit{}), std::nullopt);
  ASSERT_EQ(parse_decimal("9223372036.854775807", d), NumberStatus::kOk);
  EXPECT_EQ(to_nanoseconds(d, TimeUnit{}), std::numeric_limits<std::int64_t>::max());
}

TEST(TimeUnit, IndexAtRate) {
  const TimeUnit unit = parse_time_unit("index@2000/7");
  EXPECT_EQ(to_nanoseconds({.whole = 1}, unit), 3'500'000);
  EXPECT_EQ(to_nanoseconds({.whole = 52517}, unit), 183'809'500'000);
  EXPECT_EQ(to_nanoseconds({.whole = 9932}, parse_time_unit("index@99.32")), 100'000'000'000);
  EXPECT_EQ(to_nanoseconds({.whole = 0, .nano = 1}, unit), std::nullopt);
  EXPECT_EQ(to_nanoseconds({.whole = INT64_MAX}, parse_time_unit("index@1/900000000")), std::nullopt);
  for (const char* bad : {"index", "index@", "index@0", "index@-3", "index@1/0", "index@x", "h", "S", "index@2/3/4"}) {
    EXPECT_THROW(parse_time_unit(bad), Error) << bad;
  }
}

TEST(Double, ReadsBackWhatWasWritten) {
  const RandomStream random(3, "doubles");
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const double value = random.normal(i) * std::pow(10.0, static_cast<double>(i % 60) - 30.0);
    std::string text;
    append_number(text, value);
    double back = 0.0;
    ASSERT_EQ(parse_double(text, back), NumberStatus::kOk);
    EXPECT_EQ(std::memcmp(&value, &back, sizeof value), 0) << text;
  }
}

TEST(Double, Table) {
  double x = 0.0;
  EXPECT_EQ(parse_double("+1.5", x), NumberStatus::kOk);
  EXPECT_EQ(x, 1.5);
  EXPECT_EQ(parse_double("1e400", x), NumberStatus::kOutOfRange);
  EXPECT_EQ(parse_double("-1e400", x), NumberStatus::kOutOfRange);
  EXPECT_EQ(parse_double("1e-400", x), NumberStatus::kOk);
  EXPECT_EQ(x, 0.0);
  EXPECT_EQ(parse_double("NaN", x), NumberStatus::kOk);
  EXPECT_TRUE(std::isnan(x));
  for (const char* bad : {"", "+", "+-1", "0.12abc", "1,5", "--1", "1 2", "0x1p3"}) {
    EXPECT_EQ(parse_double(bad, x), NumberStatus::kNotNumber) << bad;
  }
}

TEST(Seconds, NineDecimalsAndNoneTooMany) {
  const auto both = [](std::int64_t ns) {
    std::string text;
    append_seconds(text, time_from_ns(ns));
    text += ' ';
    append_short_seconds(text, time_from_ns(ns));
    return text;
  };
  EXPECT_EQ(both(1520530308181901469), "1520530308.181901469 1520530308.181901469");
  EXPECT_EQ(both(5'000'000), "0.005000000 0.005");
  EXPECT_EQ(both(20'000'000'000), "20.000000000 20");
  EXPECT_EQ(both(0), "0.000000000 0");
  EXPECT_EQ(both(-1), "-0.000000001 -0.000000001");
}

}  // namespace
}  // namespace vispline

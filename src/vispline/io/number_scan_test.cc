#include "vispline/io/number_scan.h"

#include <gtest/gtest.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string>

#include "vispline/core/random.h"

namespace vispline {
namespace {

/// What the standard library makes of the number at the start of `text`.
struct Reference {
  double value = 0.0;
  std::size_t size = 0;
};

Reference reference(const std::string& text) {
  Reference result;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), result.value);
  result.size = error == std::errc() ? static_cast<std::size_t>(stop - text.data()) : 0;
  return result;
}

/// Whatever the scan takes, it takes as the library does, to the last bit and the last byte.
bool agrees(const std::string& text) {
  double value = 0.0;
  const char* const stop = scan_double(text.data(), text.data() + text.size(), value);
  if (stop == nullptr) return true;
  const Reference expected = reference(text);
  const bool same = std::memcmp(&value, &expected.value, sizeof value) == 0;
  EXPECT_TRUE(same) << text;
  EXPECT_EQ(static_cast<std::size_t>(stop - text.data()), expected.size) << text;
  return same;
}

std::string random_digits(const RandomStream& random, std::uint64_t index, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    text +=
        static_cast<char>('0' + static_cast<int>(10.0 * random.uniform_pair(index * 64 + static_cast<unsigned>(i))[0]));
  }
  return text;
}

TEST(NumberScan, RandomDigitsOfEveryLength) {
  const RandomStream random(3, "digits");
  std::uint64_t index = 0, taken = 0;
  for (int whole = 0; whole <= 21; ++whole) {
    for (int decimals = 0; decimals <= 30; ++decimals) {
      for (int i = 0; i < 20; ++i, ++index) {
        std::string text = (i % 2 ? "-" : "") + random_digits(random, 2 * index, whole);
        if (decimals > 0 || i % 3 == 0) text += "." + random_digits(random, 2 * index + 1, decimals);
        text += i % 4 == 0 ? "" : (i % 4 == 1 ? ",1" : (i % 4 == 2 ? "/" : " 12345678"));
        ASSERT_TRUE(agrees(text));
        double value = 0.0;
        taken += scan_double(text.data(), text.data() + text.size(), value) != nullptr;
      }
    }
  }
  EXPECT_GT(taken, index / 4);
}

TEST(NumberScan, ShortestAndSeventeenDigitsOfRandomDoubles) {
  const RandomStream random(4, "doubles");
  for (std::uint64_t i = 0; i < 100000; ++i) {
    const double value = random.normal(i) * std::pow(10.0, static_cast<double>(i % 12) - 6.0);
    std::array<char, 64> text;
    for (const int precision : {6, 9, 15, 16, 17, 18}) {
      const auto [end, error] =
          std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, precision);
      ASSERT_TRUE(agrees(std::string(text.data(), end)));
    }
  }
}

/// Exactly between two doubles, and one unit to each side: 2^53 + 1 halves, and so on.
TEST(NumberScan, TiesGoToTheEvenNeighbour) {
  for (const char* text :
       {"9007199254740993", "9007199254740992.5", "9007199254740993.5", "4503599627370496.5", "4503599627370497.5",
        "4503599627370497.4", "4503599627370497.6", "9007199254740991.5", "18014398509481986", "1125899906842624.125",
        "1125899906842624.375", "0.5000000000000001110", "9223372036854775807", "9999999999999999999",
        "0.9999999999999999999", "0.000000000000000001", "0", "-0", "0.000000000000000000000000000"}) {
    double value = 0.0;
    EXPECT_NE(scan_double(text, text + std::strlen(text), value), nullptr) << text;
    EXPECT_TRUE(agrees(text));
  }
}

TEST(NumberScan, LeavesTheRestToTheCarefulReader) {
  for (const char* text : {"", "-", ".", "-.", "+1", "1e5", "1.5E-3", "nan", "inf", "abc", ",", "--1",
                           "12345678901234567890", "0.1234567890123456789012345678"}) {
    double value = 7.0;
    EXPECT_EQ(scan_double(text, text + std::strlen(text), value), nullptr) << text;
    EXPECT_EQ(value, 7.0);
  }
}

TEST(NumberScan, DecimalsAreThoseOfTheCarefulReader) {
  for (const char* text : {"0", "1520530308.181901469", "1520530308181901469", "5.", "0.5", "12.000000001", "007",
                           "9223372036854775806"}) {
    Decimal fast, careful;
    ASSERT_EQ(scan_decimal(text, text + std::strlen(text), fast), text + std::strlen(text)) << text;
    ASSERT_EQ(parse_decimal(text, careful), NumberStatus::kOk);
    EXPECT_EQ(fast.whole, careful.whole);
    EXPECT_EQ(fast.nano, careful.nano);
    EXPECT_FALSE(fast.scientific);
  }
  for (const char* text :
       {"", ".5", "-1", "+1", "1e3", "9223372036854775807", "99999999999999999999", "1.0123456789", "x"}) {
    Decimal fast;
    EXPECT_EQ(scan_decimal(text, text + std::strlen(text), fast), nullptr) << text;
  }
}

}  // namespace
}  // namespace vispline

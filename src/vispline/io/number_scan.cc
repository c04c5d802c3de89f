#include "vispline/io/number_scan.h"

#include <array>
#include <bit>
#include <cstring>

namespace vispline {
namespace {

constexpr int kMaxDigits = 19;  // all of them fit into 64 bits
constexpr std::uint64_t kExactDouble = std::uint64_t{1} << 53;

template <class Number>
constexpr std::array<Number, kMaxDigits + 1> powers_of_ten() {
  std::array<Number, kMaxDigits + 1> powers{1};
  for (std::size_t i = 1; i < powers.size(); ++i) powers[i] = powers[i - 1] * 10;
  return powers;
}

constexpr auto kPowers = powers_of_ten<std::uint64_t>();
constexpr auto kDoublePowers = powers_of_ten<double>();  // exact up to 1e22

struct Digits {
  std::uint64_t value = 0;
  int count = 0;  ///< more than kMaxDigits: the value has overflowed
};

/// Are the eight bytes digits? Each is 0x30..0x39, and stays below 0x40 when 6 is added.
bool are_digits(std::uint64_t bytes) {
  constexpr std::uint64_t kHigh = 0xf0f0f0f0f0f0f0f0, kSix = 0x0606060606060606, kZeros = 0x3030303030303030;
  return (bytes & kHigh) == kZeros && ((bytes + kSix) & kHigh) == kZeros;
}

/// Eight digits, the first in the lowest byte: neighbours are joined in pairs, then fours, then all.
std::uint64_t joined(std::uint64_t bytes) {
  bytes -= 0x3030303030303030;
  bytes = (bytes * 10 + (bytes >> 8)) & 0x00ff00ff00ff00ff;
  bytes = (bytes * 100 + (bytes >> 16)) & 0x0000ffff0000ffff;
  return (bytes * 10000 + (bytes >> 32)) & 0x00000000ffffffff;
}

const char* scan_digits(const char* p, const char* end, Digits& digits) {
  const char* const begin = p;
  if constexpr (std::endian::native == std::endian::little) {
    for (std::uint64_t bytes = 0; end - p >= 8; p += 8) {
      std::memcpy(&bytes, p, 8);
      if (!are_digits(bytes)) break;
      digits.value = digits.value * 100'000'000 + joined(bytes);
    }
  }
  for (; p < end && *p >= '0' && *p <= '9'; ++p) digits.value = digits.value * 10 + static_cast<unsigned>(*p - '0');
  digits.count += static_cast<int>(p - begin);
  return p;
}

/// value / divisor, rounded once: the quotient has at least 62 bits, and its last bit says whether there is a rest.
double rounded_quotient(std::uint64_t value, std::uint64_t divisor) {
  const int up = std::countl_zero(value), down = std::countl_zero(divisor);
  const unsigned __int128 numerator = static_cast<unsigned __int128>(value << up) << 63;
  const std::uint64_t full = divisor << down;
  const auto quotient = static_cast<std::uint64_t>(numerator / full);
  const std::uint64_t sticky = numerator != static_cast<unsigned __int128>(quotient) * full;
  const std::uint64_t exponent = static_cast<std::uint64_t>(1023 + down - up - 63) << 52;
  return static_cast<double>(quotient | sticky) * std::bit_cast<double>(exponent);
}

double quotient_of(std::uint64_t value, int decimals) {
  const auto place = static_cast<std::size_t>(decimals);
  if (value < kExactDouble) return static_cast<double>(value) / kDoublePowers[place];
  return rounded_quotient(value, kPowers[place]);
}

bool goes_on(const char* p, const char* end) { return p < end && (*p == 'e' || *p == 'E'); }

}  // namespace

const char* scan_double(const char* p, const char* end, double& out) {
  const bool negative = p < end && *p == '-';
  Digits digits;
  p = scan_digits(p + negative, end, digits);
  int decimals = 0;
  if (p < end && *p == '.') {
    const int whole = digits.count;
    p = scan_digits(p + 1, end, digits);
    decimals = digits.count - whole;
  }
  if (digits.count == 0 || digits.count > kMaxDigits || goes_on(p, end)) return nullptr;
  const double value = quotient_of(digits.value, decimals);
  out = negative ? -value : value;
  return p;
}

const char* scan_decimal(const char* p, const char* end, Decimal& out) {
  Digits whole, fraction;
  p = scan_digits(p, end, whole);
  if (p < end && *p == '.') p = scan_digits(p + 1, end, fraction);
  if (whole.count == 0 || whole.count > 18 || fraction.count > 9 || goes_on(p, end)) return nullptr;
  out = {.whole = static_cast<std::int64_t>(whole.value),
         .nano = static_cast<std::int32_t>(fraction.value * kPowers[static_cast<std::size_t>(9 - fraction.count)]),
         .scientific = false};
  return p;
}

}  // namespace vispline

#include "vispline/io/number_scan.h"

#include <array>
#include <bit>
#include <cstring>

namespace vispline {
namespace {

constexpr int kMaxDigits = 19;  // as many fit into 64 bits
constexpr std::uint64_t kMaxWhole = INT64_MAX - 1;
constexpr std::uint64_t kExactDouble = std::uint64_t{1} << 53;

constexpr int kMaxDecimals = 27;    // 5^27 fits into 64 bits
constexpr int kMaxExactPower = 22;  // 10^22 is a double

template <class Number, std::size_t size>
constexpr std::array<Number, size> powers_of(Number base) {
  std::array<Number, size> powers{1};
  for (std::size_t i = 1; i < powers.size(); ++i) powers[i] = powers[i - 1] * base;
  return powers;
}

constexpr auto kTens = powers_of<std::uint64_t, 10>(10);
constexpr auto kFives = powers_of<std::uint64_t, kMaxDecimals + 1>(5);
constexpr auto kExactTens = powers_of<double, kMaxExactPower + 1>(10.0);

struct Digits {
  std::uint64_t value = 0;
  int count = 0;  ///< more than kMaxDigits: the value has overflowed
};

constexpr std::uint64_t kZeros = 0x3030303030303030;

/// The highest bit of each byte above 9; exact up to the first such byte, the lowest.
std::uint64_t above_nine(std::uint64_t bytes) { return ((bytes + 0x7676767676767676) | bytes) & 0x8080808080808080; }

/// Eight digits 0..9, the first in the lowest byte: neighbours are joined in pairs, then fours, then all.
std::uint64_t joined(std::uint64_t digits) {
  digits = (digits * 10 + (digits >> 8)) & 0x00ff00ff00ff00ff;
  digits = (digits * 100 + (digits >> 16)) & 0x0000ffff0000ffff;
  return (digits * 10000 + (digits >> 32)) & 0x00000000ffffffff;
}

/// Few digits, as many as in the number before: one branch each.
[[gnu::always_inline]] inline const char* scan_few(const char* p, const char* end, Digits& digits) {
  const char* const begin = p;
  for (; p < end && *p >= '0' && *p <= '9'; ++p) digits.value = digits.value * 10 + static_cast<unsigned>(*p - '0');
  digits.count += static_cast<int>(p - begin);
  return p;
}

/// Eight bytes at a time, and no branch on how many of the last eight are digits: that is hard to foretell.
[[gnu::always_inline]] inline const char* scan_many(const char* p, const char* end, Digits& digits) {
  if constexpr (std::endian::native != std::endian::little) return scan_few(p, end, digits);
  while (end - p >= 8) {
    std::uint64_t bytes = 0;
    std::memcpy(&bytes, p, 8);
    bytes ^= kZeros;
    const std::uint64_t others = above_nine(bytes);
    const int size = others == 0 ? 8 : std::countr_zero(others) / 8;
    if (size == 0) return p;
    digits.value = digits.value * kTens[static_cast<std::size_t>(size)] + joined(bytes << (64 - 8 * size));
    digits.count += size;
    p += size;
    if (others != 0) return p;
  }
  return scan_few(p, end, digits);
}

/// value / 10^decimals, rounded once: value / 5^decimals with at least 62 bits, of which the last says whether there is
/// a rest, times a power of two.
double rounded_quotient(std::uint64_t value, int decimals) {
  const std::uint64_t divisor = kFives[static_cast<std::size_t>(decimals)];
  const int up = std::countl_zero(value), down = std::countl_zero(divisor);
  const unsigned __int128 numerator = static_cast<unsigned __int128>(value << up) << 63;
  const std::uint64_t full = divisor << down;
  const auto quotient = static_cast<std::uint64_t>(numerator / full);
  const std::uint64_t sticky = numerator != static_cast<unsigned __int128>(quotient) * full;
  const auto exponent = static_cast<std::uint64_t>(1023 + down - up - 63 - decimals) << 52;
  return static_cast<double>(quotient | sticky) * std::bit_cast<double>(exponent);
}

double quotient_of(std::uint64_t value, int decimals) {
  if (value == 0) return 0.0;
  const bool exact = value < kExactDouble && decimals <= kMaxExactPower;
  return exact ? static_cast<double>(value) / kExactTens[static_cast<std::size_t>(decimals)]
               : rounded_quotient(value, decimals);
}

bool goes_on(const char* p, const char* end) { return p < end && (*p == 'e' || *p == 'E'); }

}  // namespace

const char* scan_double(const char* p, const char* end, double& out) {
  const bool negative = p < end && *p == '-';
  Digits digits;
  p = scan_few(p + negative, end, digits);
  int decimals = 0, zeros = digits.value == 0 ? digits.count : 0;
  if (p < end && *p == '.') {
    const char* const fraction = ++p;
    for (; zeros == digits.count && p < end && *p == '0'; ++p) {
      ++digits.count;
      ++zeros;
    }
    p = scan_many(p, end, digits);
    decimals = static_cast<int>(p - fraction);
  }
  const bool fits = digits.count - zeros <= kMaxDigits && decimals <= kMaxDecimals;
  if (digits.count == 0 || !fits || goes_on(p, end)) return nullptr;
  const double value = quotient_of(digits.value, decimals);
  out = negative ? -value : value;
  return p;
}

const char* scan_decimal(const char* p, const char* end, Decimal& out) {
  Digits whole, fraction;
  p = scan_many(p, end, whole);
  if (p < end && *p == '.') p = scan_many(p + 1, end, fraction);
  if (whole.count == 0 || whole.count > kMaxDigits || whole.value > kMaxWhole || fraction.count > 9 || goes_on(p, end))
    return nullptr;
  out = {.whole = static_cast<std::int64_t>(whole.value),
         .nano = static_cast<std::int32_t>(fraction.value * kTens[static_cast<std::size_t>(9 - fraction.count)]),
         .scientific = false};
  return p;
}

}  // namespace vispline

#include "vispline/io/number_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

namespace vispline {
namespace {

constexpr std::int64_t kNano = 1'000'000'000;
constexpr std::uint64_t kMaxWhole = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()) - 1;
constexpr int kMaxShift = 64;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

struct Unsigned {
  std::uint64_t whole = 0;
  std::int64_t nano = 0;
  bool fits = true;
};

void push_whole(Unsigned& number, char c) {
  const auto digit = static_cast<std::uint64_t>(c - '0');
  if (number.whole > (kMaxWhole - digit) / 10) number.fits = false;
  number.whole = number.fits ? number.whole * 10 + digit : number.whole;
}

/// Digits after the point: nine kept, the tenth rounds.
const char* parse_fraction(const char* p, const char* end, Unsigned& number) {
  std::int64_t scale = kNano;
  bool up = false;
  for (const char* begin = p; p < end && is_digit(*p); ++p) {
    const auto place = p - begin;
    if (place < 9) number.nano += (scale /= 10) * (*p - '0');
    if (place == 9) up = *p >= '5';
  }
  number.nano += up ? 1 : 0;
  return p;
}

NumberStatus finish(Unsigned number, bool negative, Decimal& out) {
  if (number.nano == kNano) {
    number.nano = 0;
    ++number.whole;
  }
  if (!number.fits || number.whole > kMaxWhole) return NumberStatus::kOutOfRange;
  out.whole = static_cast<std::int64_t>(number.whole);
  out.nano = static_cast<std::int32_t>(number.nano);
  if (!negative) return NumberStatus::kOk;
  out.whole = -out.whole - (out.nano > 0 ? 1 : 0);
  out.nano = out.nano > 0 ? static_cast<std::int32_t>(kNano - out.nano) : 0;
  return NumberStatus::kOk;
}

/// mantissa e exponent, by moving the decimal point in the text.
NumberStatus parse_scientific(std::string_view mantissa, std::string_view exponent, bool negative, Decimal& out) {
  int shift = 0;
  if (exponent.starts_with('+')) exponent.remove_prefix(1);
  const auto [end, error] = std::from_chars(exponent.data(), exponent.data() + exponent.size(), shift);
  if (error == std::errc::invalid_argument || end != exponent.data() + exponent.size()) return NumberStatus::kNotNumber;
  const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
  std::string digits(mantissa.substr(0, point));
  if (point < mantissa.size()) digits += mantissa.substr(point + 1);
  const std::size_t significant = std::min(digits.find_first_not_of('0'), digits.size());
  if (significant == digits.size()) shift = 0;
  if (error == std::errc::result_out_of_range || shift > kMaxShift) return NumberStatus::kOutOfRange;
  const long place = static_cast<long>(point) + std::max(shift, -kMaxShift * 2);
  if (place <= 0) digits.insert(0, static_cast<std::size_t>(1 - place), '0');
  const auto at = static_cast<std::size_t>(std::max(place, 1L));
  if (at > digits.size()) digits.append(at - digits.size(), '0');
  digits.insert(at, 1, '.');
  const NumberStatus status = parse_decimal((negative ? "-" : "") + digits, out);
  out.scientific = true;
  return status;
}

bool is_word(std::string_view text, std::string_view word) {
  if (text.size() != word.size()) return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if ((text[i] | 0x20) != word[i]) return false;
  }
  return true;
}

}  // namespace

NumberStatus parse_decimal(std::string_view text, Decimal& out) {
  const char* p = text.data();
  const char* const end = p + text.size();
  const bool negative = p < end && *p == '-';
  if (p < end && (*p == '-' || *p == '+')) ++p;
  const char* const begin = p;
  Unsigned number;
  while (p < end && is_digit(*p)) push_whole(number, *p++);
  auto digits = p - begin;
  if (p < end && *p == '.') {
    const char* const fraction = ++p;
    p = parse_fraction(p, end, number);
    digits += p - fraction;
  }
  const std::string_view rest(p, static_cast<std::size_t>(end - p));
  if (digits == 0) {
    const bool word = is_word(rest, "nan") || is_word(rest, "inf") || is_word(rest, "infinity");
    return word ? NumberStatus::kNotFinite : NumberStatus::kNotNumber;
  }
  if (!rest.empty() && (rest[0] == 'e' || rest[0] == 'E')) {
    return parse_scientific({begin, static_cast<std::size_t>(p - begin)}, rest.substr(1), negative, out);
  }
  out.scientific = false;
  return rest.empty() ? finish(number, negative, out) : NumberStatus::kNotNumber;
}

NumberStatus parse_double(std::string_view text, double& out) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, out);
  if (error == std::errc::invalid_argument || stop != end) return NumberStatus::kNotNumber;
  if (error == std::errc()) return NumberStatus::kOk;
  const std::size_t exponent = text.find_first_of("eE");
  const bool tiny = exponent == std::string_view::npos ? text.find_first_of("123456789") > text.find('.')
                                                       : text.substr(exponent + 1).starts_with('-');
  if (!tiny) return NumberStatus::kOutOfRange;
  out = 0.0;
  return NumberStatus::kOk;
}

void append_number(std::string& out, double value) {
  std::array<char, 32> text;
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  out.append(text.data(), end);
}

void append_number(std::string& out, std::int64_t value) {
  std::array<char, 24> text;
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  out.append(text.data(), end);
}

void append_seconds(std::string& out, Time time) {
  const std::int64_t ns = to_ns(time);
  if (ns < 0) out += '-';
  const std::uint64_t magnitude = ns < 0 ? 0 - static_cast<std::uint64_t>(ns) : static_cast<std::uint64_t>(ns);
  append_number(out, static_cast<std::int64_t>(magnitude / kNano));
  std::array<char, 10> fraction;
  fraction[0] = '.';
  std::uint64_t rest = magnitude % kNano;
  for (std::size_t i = 9; i > 0; --i, rest /= 10) fraction[i] = static_cast<char>('0' + rest % 10);
  out.append(fraction.data(), fraction.size());
}

void append_short_seconds(std::string& out, Time time) {
  append_seconds(out, time);
  out.erase(out.find_last_not_of('0') + 1);
  if (out.back() == '.') out.pop_back();
}

std::string brief(double value) {
  std::array<char, 32> text;
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 6);
  return {text.data(), end};
}

std::string brief_seconds(double seconds) {
  std::array<char, 340> text;
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), seconds, std::chars_format::fixed, 3);
  return std::string(text.data(), end) + " s";
}

}  // namespace vispline

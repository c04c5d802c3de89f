#include "vispline/report/number.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

namespace vispline::report {
namespace {

std::string with_format(double value, std::chars_format format, int precision) {
  std::array<char, 400> buffer;  // the longest double in fixed notation has 309 digits before the point
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, format, precision).ptr;
  return std::string(buffer.data(), end);
}

int exponent_of(std::string_view scientific) {
  std::string_view digits = scientific.substr(scientific.find('e') + 1);
  if (digits.starts_with('+')) digits.remove_prefix(1);
  int exponent = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
  return exponent;
}

}  // namespace

std::string joined(std::initializer_list<std::string_view> pieces) {
  std::string text;
  for (const std::string_view piece : pieces) text += piece;
  return text;
}

double power_of_ten(int exponent) {
  const std::string text = joined({"1e", std::to_string(exponent)});
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

int decimal_exponent(double value) {
  std::array<char, 40> buffer;
  const auto format = std::chars_format::scientific;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), std::abs(value), format).ptr;
  return exponent_of(std::string_view(buffer.data(), end));
}

std::string coordinate(double value) {
  std::string text = with_format(value, std::chars_format::fixed, 2);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string fixed_decimals(double value, int decimals) {
  return with_format(value, std::chars_format::fixed, std::clamp(decimals, 0, 30));
}

std::string significant(double value, int digits) {
  if (!std::isfinite(value)) return "—";
  if (value == 0.0) return "0";
  const int precision = std::clamp(digits, 1, 17) - 1;
  const std::string scientific = with_format(value, std::chars_format::scientific, precision);
  const int exponent = exponent_of(scientific);
  if (exponent >= -3 && exponent < 6) return fixed_decimals(value, std::max(0, precision - exponent));
  return scientific.substr(0, scientific.find('e') + 1) + std::to_string(exponent);
}

}  // namespace vispline::report

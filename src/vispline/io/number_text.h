/// Numbers to text and back, the same in every locale: shortest digits that read back to the same double, exact stamps.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "vispline/core/time.h"

namespace vispline {

/// A decimal number, exact to 1e-9: whole + nano * 1e-9 with 0 <= nano < 1e9. Stamps never go through a double.
struct Decimal {
  std::int64_t whole = 0;
  std::int32_t nano = 0;
  bool scientific = false;  ///< was written with an exponent
  double value() const { return static_cast<double>(whole) + 1e-9 * nano; }
};

enum class NumberStatus { kOk, kNotNumber, kNotFinite, kOutOfRange };

/// All of `text` must be the number. kOutOfRange: beyond 64 bits.
NumberStatus parse_decimal(std::string_view text, Decimal& out);

/// All of `text` must be the number; nan and inf are kOk. kOutOfRange: above 1.8e308; too small becomes 0.
NumberStatus parse_double(std::string_view text, double& out);

void append_number(std::string& out, double value);
void append_number(std::string& out, std::int64_t value);
/// Seconds with exactly nine decimals.
void append_seconds(std::string& out, Time time);
/// Seconds with as many decimals as needed: 0.005.
void append_short_seconds(std::string& out, Time time);
/// A number for a message: six significant digits.
std::string brief(double value);
/// Seconds for a message: three decimals and the unit.
std::string brief_seconds(double seconds);

}  // namespace vispline

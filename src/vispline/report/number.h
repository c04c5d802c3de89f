/// Numbers as text: the same bytes in every locale and on every run.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace vispline::report {

/// The pieces as one text.
std::string joined(std::initializer_list<std::string_view> pieces);

/// The double nearest to 10^exponent; exponent in [-307, 308].
double power_of_ten(int exponent);

/// The exponent of the shortest decimal that reads back as value, so that 1e-6 has -6 although its double lies below.
/// Finite and not zero.
int decimal_exponent(double value);

/// A coordinate of a drawing: at most two decimals, no trailing zeros, never "-0". Finite.
std::string coordinate(double value);

/// A fixed number of decimals; finite.
std::string fixed_decimals(double value, int decimals);

/// A cell of a table: `digits` significant digits, trailing zeros kept, as 0.001286 or 1.286e-7 outside [1e-3, 1e6).
/// Values that are not finite read "—".
std::string significant(double value, int digits);

}  // namespace vispline::report

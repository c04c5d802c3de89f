/// The common spellings of numbers, fast: what these functions do not take is left to number_text.h, which has the same
/// answer for what they do.
#pragma once

#include "vispline/io/number_text.h"

namespace vispline {

/// `[-]digits[.digits]` with at most 19 significant digits and 27 decimals, rounded to the nearest double. Returns the
/// end of the number, or null (and leaves `out` alone) if the text at `p` is written in any other way.
const char* scan_double(const char* p, const char* end, double& out);

/// `digits[.digits]` below 2^63 - 1 with at most 9 digits after the point: no sign, no exponent. Null as above.
const char* scan_decimal(const char* p, const char* end, Decimal& out);

}  // namespace vispline

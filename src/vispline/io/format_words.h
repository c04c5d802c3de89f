/// Small pieces that several formats share.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "vispline/core/types.h"
#include "vispline/io/number_text.h"
#include "vispline/io/text_layout.h"

namespace vispline {

/// Is `word` (lower case) a column name, apart from # and units?
bool names_hold(const std::vector<std::string>& header, std::string_view word);

/// Do columns first .. first + 3 of the first rows hold unit quaternions (to 0.1)?
bool sample_holds_quaternions(const TextLayout& layout, std::size_t first);

/// Is the first stamp an integer above 1e17, that is nanoseconds since 1970?
bool sample_is_epoch_nanoseconds(const TextLayout& layout);

/// Each number after a separator.
template <class Vector>
void append_cells(std::string& out, char separator, const Vector& numbers) {
  for (Eigen::Index i = 0; i < numbers.size(); ++i) {
    out += separator;
    append_number(out, static_cast<double>(numbers[i]));
  }
}

}  // namespace vispline

/// The rows of a text table as columns of numbers, and the exact decimals of its stamps.
#pragma once

#include <string_view>
#include <vector>

#include "vispline/io/number_text.h"
#include "vispline/io/read_context.h"
#include "vispline/io/text_layout.h"

namespace vispline {

/// A stamp that is a number but cannot be one of a recording (nan, or beyond 64 bits) is stored so.
inline constexpr std::int64_t kNoStamp = INT64_MIN;

struct TextTable {
  std::vector<Decimal> stamps;               ///< empty if no column of stamps was asked for
  std::vector<std::vector<double>> columns;  ///< in the order asked for; a missing cell is nan
  std::size_t rows = 0;
};

/// Which columns of the file are wanted, counted from 0.
struct WantedColumns {
  int stamp = -1;           ///< -1: none
  std::vector<int> values;  ///< each at most once
};

/// Counts every row as read and the left-out ones as dropped, notes line numbers in the context. Throws E-CSV with the
/// cell for a malformed row (or W-CSV with skip_bad_rows, up to 0.1 %), E-DECIMAL, E-LIMIT. A last row that is cut is
/// W-TRUNCATED. Cells of columns that are not wanted are not looked at.
TextTable read_table(ReadContext& context, std::string_view text, const TextLayout& layout,
                     const WantedColumns& wanted);

}  // namespace vispline

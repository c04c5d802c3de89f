/// One row of a text table: the exact decimal of its stamp and the numbers of the wanted columns.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "vispline/io/number_text.h"
#include "vispline/io/text_layout.h"

namespace vispline {

/// A stamp that is a number but cannot be one of a recording (nan, or beyond 64 bits) is stored so.
inline constexpr std::int64_t kNoStamp = INT64_MIN;

/// As many numbers as any signal has columns: a position and a quaternion.
inline constexpr std::size_t kMaxValues = 7;
using RowValues = std::array<double, kMaxValues>;

struct TextRow {
  Decimal stamp;           ///< 0 if no column of stamps was asked for
  RowValues values;        ///< in the order asked for; a missing cell, and a column not in the file, is nan
  std::int64_t line = 0;   ///< from 1
  std::int64_t index = 0;  ///< place among all rows, malformed ones included; from 0
};

/// Which columns of the file are wanted, counted from 0; -1: none.
struct WantedColumns {
  int stamp = -1;
  int stamp_nano = -1;      ///< nanoseconds that are added to whole seconds in `stamp`
  std::vector<int> values;  ///< at most kMaxValues, each column at most once
};

/// Why a row cannot be read: E-CSV, E-DECIMAL or E-LIMIT, and one sentence.
struct BadRow {
  std::string code;
  std::string message;
};

class RowReader {
 public:
  RowReader(const TextLayout& layout, const WantedColumns& wanted);

  /// Fills stamp and values of `row`. False: `bad` says why. Cells of columns that are not wanted are not looked at.
  bool read(std::string_view line, TextRow& row, BadRow& bad) const;

 private:
  bool read_fast(std::string_view line, TextRow& row) const;
  const char* read_cell(const char* p, const char* end, int slot, TextRow& row) const;
  bool read_careful(std::string_view line, TextRow& row, BadRow& bad) const;
  bool parse_cell(std::string_view cell, std::size_t column, TextRow& row, BadRow& bad) const;

  const TextLayout& layout_;
  std::vector<int> slot_;  ///< for each column of the file: place among the values, or what else it is
  RowValues absent_;
  bool fast_;
  char blank_;  ///< the second character, besides ' ', that may stand around a cell
};

}  // namespace vispline

/// The rows of a text table one after another, each counted as read, the left-out ones as dropped.
#pragma once

#include "vispline/io/text_lines.h"
#include "vispline/io/text_row.h"

namespace vispline {

class RowStream {
 public:
  /// `lines` must stand at the first row. `layout` must outlive this.
  RowStream(ReadContext& context, TextLines& lines, const TextLayout& layout, const WantedColumns& wanted);

  /// The next well-formed row; false at the end. Throws E-CSV with the cell for a malformed row (or W-CSV with
  /// skip_bad_rows, judged at the end: at most 0.1 %), E-DECIMAL, E-LIMIT. A last row that is cut is W-TRUNCATED.
  bool next(TextRow& row);
  /// The line of that row, until the next call.
  std::string_view line() const { return line_; }

 private:
  bool take(const TextLine& line, TextRow& row);
  void refuse(const BadRow& bad, std::int64_t line);
  void finish() const;

  ReadContext& context_;
  TextLines& lines_;
  const TextLayout& layout_;
  RowReader reader_;
  std::int64_t bad_rows_ = 0;
  std::string_view line_{};
};

}  // namespace vispline

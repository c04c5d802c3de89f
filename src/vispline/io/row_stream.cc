#include "vispline/io/row_stream.h"

#include <algorithm>
#include <string>
#include <vector>

#include "vispline/io/text_cells.h"

namespace vispline {
namespace {

/// Digits after the decimal mark; an exponent makes it unknown.
struct CellEnd {
  std::size_t decimals;
  bool exponent;
};

CellEnd end_of(std::string_view cell, char decimal) {
  const std::size_t point = cell.find(decimal);
  const std::size_t exponent = cell.find_first_of("eE");
  if (exponent != std::string_view::npos) return {cell.size() - exponent - 1, true};
  return {point == std::string_view::npos ? 0 : cell.size() - point - 1, false};
}

/// A last row without a line end is whole if its last cell is written as finely as those of the first rows.
bool last_cell_is_whole(std::string_view line, const TextLayout& layout) {
  const std::vector<std::string_view> cells = split_cells(line, layout.separator);
  if (cells.size() > layout.fields || line.back() == ' ') return true;  // a separator ends the last cell
  if (cells.back().empty()) return false;
  const CellEnd last = end_of(cells.back(), layout.decimal);
  std::size_t fewest = SIZE_MAX;
  bool exponents = false;
  for (const auto& row : layout.sample) {
    if (row.size() != layout.fields) continue;
    const CellEnd other = end_of(row.back(), layout.decimal);
    exponents |= other.exponent;
    if (!other.exponent) fewest = std::min(fewest, other.decimals);
  }
  if (last.exponent) return last.decimals >= 3;  // a sign and two digits, as printf and to_chars write
  return !exponents && last.decimals >= fewest;
}

bool is_skipped(std::string_view line) { return (line.empty() || line[0] <= '%') && is_comment(line); }

}  // namespace

RowStream::RowStream(ReadContext& context, TextLines& lines, const TextLayout& layout, const WantedColumns& wanted)
    : context_(context), lines_(lines), layout_(layout), reader_(layout, wanted) {}

bool RowStream::next(TextRow& row) {
  for (TextLine line; lines_.next(line);) {
    if (!is_skipped(line.text) && take(line, row)) return true;
  }
  finish();
  return false;
}

bool RowStream::take(const TextLine& line, TextRow& row) {
  row.line = line.number;
  row.index = context_.counts.read++;
  line_ = line.text;
  BadRow bad;
  const bool good = reader_.read(line.text, row, bad);
  if (!line.has_end && (!good || !last_cell_is_whole(line.text, layout_)) && bad.code != "E-LIMIT") {
    context_.drop("W-TRUNCATED", "the last row is cut after " + std::to_string(line.text.size()) + " bytes",
                  context_.where_line(line.number));
    return false;
  }
  if (!good) refuse(bad, line.number);
  return good;
}

void RowStream::refuse(const BadRow& bad, std::int64_t line) {
  if (bad.code != "E-CSV" || !context_.options().skip_bad_rows) {
    const bool limit = bad.code == "E-LIMIT", decimal = bad.code == "E-DECIMAL";
    context_.fail(limit ? ExitCode::kLimit : ExitCode::kInput, bad.code, bad.message, context_.where_line(line),
                  decimal ? "pass --decimal , if the comma is the decimal mark"
                          : "mend the line, or pass --skip-bad-rows to leave out up to 0.1 % of the rows");
  }
  ++bad_rows_;
  context_.drop("W-CSV", bad.message, context_.where_line(line));
}

void RowStream::finish() const {
  if (context_.share(bad_rows_) <= kQuietLoss) return;
  context_.fail(ExitCode::kInput, "E-CSV", std::to_string(bad_rows_) + " malformed rows are more than 0.1 % of all",
                context_.path(), "mend the file; --skip-bad-rows leaves out up to 0.1 %");
}

}  // namespace vispline

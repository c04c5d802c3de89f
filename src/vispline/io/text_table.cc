#include "vispline/io/text_table.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <limits>
#include <string>

#include "vispline/files/limits.h"
#include "vispline/io/text_cells.h"

namespace vispline {
namespace {

constexpr int kSkipped = -1;
constexpr int kStamp = -2;

/// One row while it is read.
struct Row {
  Decimal stamp;
  std::vector<double> values;
};

struct BadRow {
  std::string code;
  std::string message;
};

class RowReader {
 public:
  RowReader(const TextLayout& layout, const WantedColumns& wanted)
      : layout_(layout), slot_(layout.fields, kSkipped), fast_(layout.decimal == '.') {
    row.values.resize(wanted.values.size());
    for (std::size_t i = 0; i < wanted.values.size(); ++i)
      slot_[static_cast<std::size_t>(wanted.values[i])] = static_cast<int>(i);
    if (wanted.stamp >= 0) slot_[static_cast<std::size_t>(wanted.stamp)] = kStamp;
  }

  Row row;

  /// False: `bad` says why.
  bool read(std::string_view line, BadRow& bad) { return (fast_ && read_fast(line)) || read_careful(line, bad); }

 private:
  /// Well-formed rows of plain numbers only; everything else is left to read_careful.
  bool read_fast(std::string_view line) {
    const char* p = line.data();
    const char* const end = p + line.size();
    const bool blanks = layout_.separator == ' ';
    for (std::size_t i = 0; i < slot_.size(); ++i) {
      while (p < end && (*p == ' ' || (*p == '\t' && layout_.separator != '\t'))) ++p;
      p = read_cell(p, end, slot_[i]);
      if (p == nullptr) return false;
      const char* const cell_end = p;
      while (p < end && (*p == ' ' || (*p == '\t' && layout_.separator != '\t'))) ++p;
      if (i + 1 == slot_.size()) break;
      if (blanks ? p == cell_end : p == end || *p++ != layout_.separator) return false;
    }
    return p == end;
  }

  const char* read_cell(const char* p, const char* end, int slot) {
    if (slot >= 0) {
      const auto [stop, error] = std::from_chars(p, end, row.values[static_cast<std::size_t>(slot)]);
      return error == std::errc() ? stop : nullptr;
    }
    const char* stop = p;
    while (stop < end && *stop != layout_.separator && *stop != ' ' && *stop != '\t' && *stop != '"') ++stop;
    if (stop < end && *stop == '"') return nullptr;
    if (slot == kSkipped) return stop;
    return parse_decimal({p, static_cast<std::size_t>(stop - p)}, row.stamp) == NumberStatus::kOk ? stop : nullptr;
  }

  bool read_careful(std::string_view line, BadRow& bad) {
    std::vector<std::string_view> cells = split_cells(line, layout_.separator);
    if (cells.size() == slot_.size() + 1 && cells.back().empty()) cells.pop_back();
    if (cells.size() > limits::kFields) {
      bad = {"E-LIMIT", "a row has more than " + std::to_string(limits::kFields) + " cells"};
      return false;
    }
    if (cells.size() != slot_.size()) {
      bad = {"E-CSV",
             "the row has " + std::to_string(cells.size()) + " cells, expected " + std::to_string(slot_.size())};
      return false;
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (slot_[i] != kSkipped && !parse_cell(cells[i], i, bad)) return false;
    }
    return true;
  }

  bool parse_cell(std::string_view cell, std::size_t column, BadRow& bad) {
    std::string text(cell);
    const bool mixed =
        layout_.decimal == ',' && text.find('.') != std::string::npos && text.find(',') != std::string::npos;
    if (layout_.decimal == ',' && !mixed) std::replace(text.begin(), text.end(), ',', '.');
    const NumberStatus status = slot_[column] == kStamp ? parse_stamp(text) : parse_value(text, slot_[column]);
    if (status == NumberStatus::kOk) return true;
    const bool comma =
        mixed || (layout_.decimal != ',' && text.find(',') != std::string::npos && is_numeric(text, ','));
    const bool thousands = text.find(',') != std::string::npos && text.find('.') != std::string::npos;
    const std::string place = " in column " + std::to_string(column + 1);
    if (comma || (thousands && text.find_first_not_of("0123456789.,+-") == std::string::npos)) {
      bad = {"E-DECIMAL", "the cell " + vispline::quoted(cell) + place + " may hold a decimal comma or thousands"};
    } else if (status == NumberStatus::kOutOfRange) {
      bad = {"E-CSV", "the cell " + vispline::quoted(cell) + place + " is beyond the range of numbers"};
    } else {
      bad = {"E-CSV", "the cell " + vispline::quoted(cell) + place + " is not a number"};
    }
    return false;
  }

  NumberStatus parse_value(std::string_view text, int slot) {
    double& value = row.values[static_cast<std::size_t>(slot)];
    if (!text.empty()) return parse_double(text, value);
    value = std::numeric_limits<double>::quiet_NaN();
    return NumberStatus::kOk;
  }

  NumberStatus parse_stamp(std::string_view text) {
    const NumberStatus status = parse_decimal(text, row.stamp);
    if (status == NumberStatus::kNotNumber) return status;
    if (status != NumberStatus::kOk) row.stamp = {.whole = kNoStamp, .nano = 0, .scientific = false};
    return NumberStatus::kOk;
  }

  const TextLayout& layout_;
  std::vector<int> slot_;  ///< for each column of the file: place in the row, kStamp or kSkipped
  bool fast_;
};

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

class TableReader {
 public:
  TableReader(ReadContext& context, std::string_view text, const TextLayout& layout, const WantedColumns& wanted)
      : context_(context), text_(text), layout_(layout), reader_(layout, wanted), stamps_(wanted.stamp >= 0) {
    table_.columns.resize(wanted.values.size());
    const std::size_t width = std::max(line_at(text, layout.data_begin).size(), 2 * layout.fields);
    const std::size_t rows = (text.size() - layout.data_begin) / width + 1;
    for (auto& column : table_.columns) column.reserve(rows);
    if (stamps_) table_.stamps.reserve(rows);
  }

  TextTable read() {
    std::int64_t number = layout_.data_line;
    for (std::size_t pos = layout_.data_begin; pos < text_.size(); ++number) {
      const std::string_view line = limited_line(context_, text_, pos, number);
      pos += line.size() + 1;
      if (!is_skipped(line)) read_row(line, number, pos > text_.size());
    }
    if (context_.share(bad_rows_) > kQuietLoss) {
      context_.fail(ExitCode::kInput, "E-CSV", std::to_string(bad_rows_) + " malformed rows are more than 0.1 % of all",
                    context_.path(), "mend the file; --skip-bad-rows leaves out up to 0.1 %");
    }
    return std::move(table_);
  }

 private:
  static bool is_skipped(std::string_view line) { return (line.empty() || line[0] <= '%') && is_comment(line); }

  void read_row(std::string_view line, std::int64_t number, bool is_last) {
    ++context_.counts.read;
    BadRow bad;
    const bool good = reader_.read(line, bad);
    if (is_last && (!good || !last_cell_is_whole(line, layout_)) && bad.code != "E-LIMIT") {
      context_.drop("W-TRUNCATED", "the last row is cut after " + std::to_string(line.size()) + " bytes",
                    context_.where_line(number));
    } else if (good) {
      keep(number);
    } else {
      refuse(bad, number);
    }
  }

  void refuse(const BadRow& bad, std::int64_t number) {
    const bool skip = bad.code == "E-CSV" && context_.options().skip_bad_rows;
    if (!skip) {
      const bool limit = bad.code == "E-LIMIT";
      const bool decimal = bad.code == "E-DECIMAL";
      context_.fail(limit ? ExitCode::kLimit : ExitCode::kInput, bad.code, bad.message, context_.where_line(number),
                    decimal ? "pass --decimal , if the comma is the decimal mark"
                            : "mend the line, or pass --skip-bad-rows to leave out up to 0.1 % of the rows");
    }
    ++bad_rows_;
    context_.drop("W-CSV", bad.message, context_.where_line(number));
  }

  void keep(std::int64_t number) {
    for (std::size_t i = 0; i < table_.columns.size(); ++i) table_.columns[i].push_back(reader_.row.values[i]);
    if (stamps_) table_.stamps.push_back(reader_.row.stamp);
    context_.lines.push_back(number);
    ++table_.rows;
  }

  ReadContext& context_;
  std::string_view text_;
  const TextLayout& layout_;
  RowReader reader_;
  bool stamps_;
  std::int64_t bad_rows_ = 0;
  TextTable table_;
};

}  // namespace

TextTable read_table(ReadContext& context, std::string_view text, const TextLayout& layout,
                     const WantedColumns& wanted) {
  return TableReader(context, text, layout, wanted).read();
}

}  // namespace vispline

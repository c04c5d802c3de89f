#include "vispline/io/text_row.h"

#include <algorithm>
#include <charconv>
#include <limits>

#include "vispline/core/error.h"
#include "vispline/files/limits.h"
#include "vispline/io/number_scan.h"
#include "vispline/io/text_cells.h"

namespace vispline {
namespace {

constexpr int kSkipped = -1;
constexpr int kStamp = -2;
constexpr int kStampNano = -3;
constexpr Decimal kNotATime = {.whole = kNoStamp, .nano = 0, .scientific = false};

const char* scan_value(const char* p, const char* end, double& value) {
  if (const char* const stop = scan_double(p, end, value)) return stop;
  const auto [stop, error] = std::from_chars(p, end, value);
  return error == std::errc() ? stop : nullptr;
}

NumberStatus parse_value(std::string_view text, double& value) {
  if (!text.empty()) return parse_double(text, value);
  value = std::numeric_limits<double>::quiet_NaN();
  return NumberStatus::kOk;
}

NumberStatus parse_stamp(std::string_view text, Decimal& stamp) {
  const NumberStatus status = parse_decimal(text, stamp);
  if (status == NumberStatus::kNotNumber) return status;
  if (status != NumberStatus::kOk) stamp = kNotATime;
  return NumberStatus::kOk;
}

/// The second column of a stamp in two: whole nanoseconds below one second.
NumberStatus parse_stamp_nano(std::string_view text, Decimal& stamp) {
  Decimal nano;
  const NumberStatus status = parse_stamp(text, nano);
  const bool fits = nano.whole >= 0 && nano.whole < 1'000'000'000 && nano.nano == 0 && stamp.nano == 0;
  if (!fits || stamp.whole == kNoStamp) {
    stamp = kNotATime;
  } else {
    stamp.nano = static_cast<std::int32_t>(nano.whole);
  }
  return status;
}

BadRow bad_cell(std::string_view cell, std::size_t column, const std::string& why) {
  return {"E-CSV", "the cell " + vispline::quoted(cell) + " in column " + std::to_string(column + 1) + " is " + why};
}

/// Does the cell hold a comma that may be a decimal mark or part thousands?
bool has_odd_comma(std::string_view text, bool mixed, char decimal) {
  const bool comma = text.find(',') != std::string_view::npos, point = text.find('.') != std::string_view::npos;
  if (mixed || (decimal != ',' && comma && is_numeric(text, ','))) return true;
  return comma && point && text.find_first_not_of("0123456789.,+-") == std::string_view::npos;
}

}  // namespace

RowReader::RowReader(const TextLayout& layout, const WantedColumns& wanted)
    : layout_(layout),
      slot_(layout.fields, kSkipped),
      fast_(layout.decimal == '.' && wanted.stamp_nano < 0),
      blank_(layout.separator == '\t' ? ' ' : '\t') {
  absent_.fill(std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < wanted.values.size(); ++i) {
    if (wanted.values[i] >= 0) slot_[static_cast<std::size_t>(wanted.values[i])] = static_cast<int>(i);
  }
  if (wanted.stamp >= 0) slot_[static_cast<std::size_t>(wanted.stamp)] = kStamp;
  if (wanted.stamp_nano >= 0) slot_[static_cast<std::size_t>(wanted.stamp_nano)] = kStampNano;
}

bool RowReader::read(std::string_view line, TextRow& row, BadRow& bad) const {
  row.values = absent_;
  return (fast_ && read_fast(line, row)) || read_careful(line, row, bad);
}

/// Well-formed rows of plain numbers only; everything else is left to read_careful.
bool RowReader::read_fast(std::string_view line, TextRow& row) const {
  const char* p = line.data();
  const char* const end = p + line.size();
  const bool blanks = layout_.separator == ' ';
  for (std::size_t i = 0; i < slot_.size(); ++i) {
    while (p < end && (*p == ' ' || *p == blank_)) ++p;
    p = read_cell(p, end, slot_[i], row);
    if (p == nullptr) return false;
    const char* const cell_end = p;
    while (p < end && (*p == ' ' || *p == blank_)) ++p;
    if (i + 1 == slot_.size()) break;
    if (blanks ? p == cell_end : p == end || *p++ != layout_.separator) return false;
  }
  return p == end;
}

const char* RowReader::read_cell(const char* p, const char* end, int slot, TextRow& row) const {
  if (slot >= 0) return scan_value(p, end, row.values[static_cast<std::size_t>(slot)]);
  if (slot == kStamp) {
    if (const char* const stop = scan_decimal(p, end, row.stamp)) return stop;
  }
  const char* stop = p;
  while (stop < end && *stop != layout_.separator && *stop != ' ' && *stop != '\t' && *stop != '"') ++stop;
  if (stop < end && *stop == '"') return nullptr;
  if (slot == kSkipped) return stop;
  return parse_decimal({p, static_cast<std::size_t>(stop - p)}, row.stamp) == NumberStatus::kOk ? stop : nullptr;
}

bool RowReader::read_careful(std::string_view line, TextRow& row, BadRow& bad) const {
  std::vector<std::string_view> cells = split_cells(line, layout_.separator);
  if (cells.size() == slot_.size() + 1 && cells.back().empty()) cells.pop_back();
  if (cells.size() > limits::kFields) {
    bad = {"E-LIMIT", "a row has more than " + std::to_string(limits::kFields) + " cells"};
    return false;
  }
  if (cells.size() != slot_.size()) {
    bad = {"E-CSV", "the row has " + std::to_string(cells.size()) + " cells, expected " + std::to_string(slot_.size())};
    return false;
  }
  for (const bool second_half : {false, true}) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (slot_[i] == kSkipped || (slot_[i] == kStampNano) != second_half) continue;
      if (!parse_cell(cells[i], i, row, bad)) return false;
    }
  }
  return true;
}

bool RowReader::parse_cell(std::string_view cell, std::size_t column, TextRow& row, BadRow& bad) const {
  std::string text(cell);
  const bool mixed =
      layout_.decimal == ',' && text.find('.') != std::string::npos && text.find(',') != std::string::npos;
  if (layout_.decimal == ',' && !mixed) std::replace(text.begin(), text.end(), ',', '.');
  const int slot = slot_[column];
  const NumberStatus status = slot == kStamp       ? parse_stamp(text, row.stamp)
                              : slot == kStampNano ? parse_stamp_nano(text, row.stamp)
                                                   : parse_value(text, row.values[static_cast<std::size_t>(slot)]);
  if (status == NumberStatus::kOk) return true;
  if (has_odd_comma(text, mixed, layout_.decimal)) {
    bad = {"E-DECIMAL", "the cell " + vispline::quoted(cell) + " in column " + std::to_string(column + 1) +
                            " may hold a decimal comma or thousands"};
  } else {
    bad = bad_cell(cell, column, status == NumberStatus::kOutOfRange ? "beyond the range of numbers" : "not a number");
  }
  return false;
}

}  // namespace vispline

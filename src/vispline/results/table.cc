#include "vispline/results/table.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "vispline/core/error.h"

namespace vispline {
namespace {

/// Columns a UTF-8 text takes: its bytes without continuation bytes.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u; }));
}

std::string padded(const std::string& cell, std::size_t columns, Table::Align align) {
  const std::string blanks(columns - width(cell), ' ');
  return align == Table::Align::kLeft ? cell + blanks : blanks + cell;
}

}  // namespace

std::string number_text(double value, int digits) {
  if (!std::isfinite(value)) return "-";
  std::array<char, 64> buffer;
  const auto [end, error] =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, digits);
  return error == std::errc() ? std::string(buffer.data(), end) : "-";
}

std::string number_text(const std::optional<double>& value, int digits) {
  return value ? number_text(*value, digits) : "-";
}

Table::Table(std::vector<Column> columns) : columns_(std::move(columns)) {}

void Table::add_row(std::vector<std::string> cells) {
  require(cells.size() == columns_.size(), "one cell for every column of a table");
  rows_.push_back(std::move(cells));
}

std::string Table::text() const {
  std::vector<std::string> headers, dashes;
  std::vector<std::size_t> widths;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    widths.push_back(width(columns_[c].header));
    for (const auto& row : rows_) widths[c] = std::max(widths[c], width(row[c]));
    headers.push_back(columns_[c].header);
    dashes.emplace_back(widths[c], '-');
  }
  std::string text;
  const auto append = [&](const std::vector<std::string>& cells) {
    for (std::size_t c = 0; c < cells.size(); ++c) {
      text += (c == 0 ? "" : "  ") + padded(cells[c], widths[c], columns_[c].align);
    }
    text.erase(text.find_last_not_of(' ') + 1);
    text += '\n';
  };
  append(headers);
  append(dashes);
  for (const auto& row : rows_) append(row);
  return text;
}

}  // namespace vispline

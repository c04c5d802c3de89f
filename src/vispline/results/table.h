/// A small text table for people: columns as wide as their widest cell, two blanks between, no lines to draw.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace vispline {

/// `value` with so many significant digits and without trailing zeros, the same in every locale; "-" if not finite.
std::string number_text(double value, int digits);
/// "-" if there is no value.
std::string number_text(const std::optional<double>& value, int digits);

class Table {
 public:
  enum class Align { kLeft, kRight };
  struct Column {
    std::string header;
    Align align = Align::kRight;
  };

  explicit Table(std::vector<Column> columns);
  /// Throws Error(kUsage) unless there is one cell for every column.
  void add_row(std::vector<std::string> cells);
  /// Header, a row of dashes, rows; every line ends with a newline and without blanks.
  std::string text() const;

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace vispline

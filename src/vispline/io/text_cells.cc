#include "vispline/io/text_cells.h"

#include <algorithm>
#include <cstring>

#include "vispline/files/limits.h"
#include "vispline/io/number_text.h"

namespace vispline {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// End of the cell that starts at `pos`: the next separator outside quotes.
std::size_t cell_end(std::string_view line, std::size_t pos, char separator) {
  bool in_quotes = false;
  for (; pos < line.size(); ++pos) {
    const char c = line[pos];
    if (c == '"') in_quotes = !in_quotes;
    if (!in_quotes && (separator == ' ' ? is_blank(c) : c == separator)) return pos;
  }
  return pos;
}

}  // namespace

void normalise_line_ends(std::string& text) {
  const std::size_t first = text.find('\r');
  if (first == std::string::npos) return;
  char* out = text.data() + first;
  const char* const end = text.data() + text.size();
  for (const char* p = out; p < end; ++p) {
    if (*p == '\r') {
      if (p + 1 < end && p[1] == '\n') ++p;
      *out++ = '\n';
    } else {
      *out++ = *p;
    }
  }
  text.resize(static_cast<std::size_t>(out - text.data()));
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && (is_blank(text.back()) || text.back() == '\f')) text.remove_suffix(1);
  return text;
}

std::string_view unquoted(std::string_view cell) {
  if (cell.size() < 2 || cell.front() != '"' || cell.back() != '"') return cell;
  return trimmed(cell.substr(1, cell.size() - 2));
}

bool is_comment(std::string_view line) {
  const std::string_view text = trimmed(line);
  return text.empty() || text[0] == '#' || text[0] == '%';
}

std::vector<std::string_view> split_cells(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  const std::string_view text = separator == ' ' ? trimmed(line) : line;
  std::size_t pos = 0;
  while (cells.size() <= limits::kFields) {
    const std::size_t end = cell_end(text, pos, separator);
    cells.push_back(unquoted(trimmed(text.substr(pos, end - pos))));
    if (end >= text.size()) break;
    pos = end + 1;
    while (separator == ' ' && pos < text.size() && is_blank(text[pos])) ++pos;
  }
  return cells;
}

std::string_view line_at(std::string_view text, std::size_t pos) {
  return text.substr(pos, std::min(text.find('\n', pos), text.size()) - pos);
}

bool is_numeric(std::string_view cell, char decimal) {
  if (cell.empty()) return true;
  std::string copy(cell);
  if (decimal == ',') std::replace(copy.begin(), copy.end(), ',', '.');
  double value = 0.0;
  return parse_double(copy, value) != NumberStatus::kNotNumber;
}

}  // namespace vispline

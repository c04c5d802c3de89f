#include "vispline/io/text_layout.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <utility>

#include "vispline/files/limits.h"
#include "vispline/io/text_cells.h"

namespace vispline {
namespace {

constexpr std::size_t kSampleRows = 20;

/// One line of the head of the file.
struct HeadLine {
  std::string_view text;
  std::size_t pos;
  std::int64_t line;
};

struct Head {
  std::vector<HeadLine> comments;  ///< before the first row
  std::vector<HeadLine> rows;      ///< up to kSampleRows + 1 lines that are no comment
  std::map<std::string, std::string> notes;
};

constexpr std::string_view kNotesFollow = "GYROFLOW IMU LOG";

/// Is the line, which is no comment, one of the notes before the table? Then it is taken.
bool take_note(std::string_view line, Head& head) {
  const bool first = head.rows.empty() && head.notes.empty() && line.starts_with(kNotesFollow);
  const bool more = head.rows.empty() && !head.notes.empty() && !line.starts_with("t,");
  if (!first && !more) return false;
  const std::size_t comma = std::min(line.find(','), line.size());
  head.notes.emplace(trimmed(line.substr(0, comma)), trimmed(line.substr(std::min(comma + 1, line.size()))));
  return true;
}

/// The line at `pos`. Throws E-LIMIT if it is longer than limits::kLineBytes.
std::string_view limited_line(const ReadContext& context, std::string_view text, std::size_t pos, std::int64_t line) {
  const std::string_view window = text.substr(pos, limits::kLineBytes + 1);
  const std::size_t length = window.find('\n');
  if (length != std::string_view::npos) return window.substr(0, length);
  if (window.size() <= limits::kLineBytes) return window;
  context.fail(ExitCode::kLimit, "E-LIMIT", "a line is longer than " + std::to_string(limits::kLineBytes) + " bytes",
               context.where_line(line), "check that this is a table with one row a line");
}

Head read_head(const ReadContext& context, std::string_view text) {
  Head head;
  std::int64_t number = 1;
  for (std::size_t pos = 0; pos < text.size() && head.rows.size() <= kSampleRows; ++number) {
    const std::string_view line = limited_line(context, text, pos, number);
    if (!is_comment(line)) {
      if (!take_note(line, head)) head.rows.push_back({line, pos, number});
    } else if (head.rows.empty() && !trimmed(line).empty()) {
      head.comments.push_back({line, pos, number});
    }
    pos += line.size() + 1;
  }
  return head;
}

bool is_number_char(char c) { return (c >= '0' && c <= '9') || c == '.' || c == ',' || c == '-' || c == '+'; }

/// "0,1 0,2": numbers with commas inside, apart by blanks.
bool has_blank_between_numbers(std::string_view line) {
  line = trimmed(line);
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    if (line[i] != ' ' && line[i] != '\t') continue;
    const std::size_t next = line.find_first_not_of(" \t", i);
    if (!is_number_char(line[i - 1]) || !is_number_char(line[next])) return false;
    if (line[i - 1] != ',' && line[next] != ',') return true;
    i = next;
  }
  return false;
}

char separator_of(std::string_view line, char decimal) {
  const auto has = [&](char c) { return line.find(c) != std::string_view::npos; };
  if (has(';')) return ';';
  const bool numbers = has_blank_between_numbers(line);
  const bool tabs_apart = has('\t') && line.find(",\t") == std::string_view::npos;
  if (has(',') && decimal != ',' && !numbers && !tabs_apart) return ',';
  return has('\t') ? '\t' : ' ';
}

std::vector<std::string> cells_of(std::string_view line, char separator) {
  const auto views = split_cells(line, separator);
  std::vector<std::string> cells(views.begin(), views.end());
  return cells;
}

bool is_decimal_comma(const std::string& cell) {
  const std::size_t comma = cell.find(',');
  return comma != std::string::npos && is_numeric(cell, ',');
}

[[noreturn]] void fail_decimal(const ReadContext& context, const HeadLine& row, const std::string& cell) {
  context.fail(ExitCode::kInput, "E-DECIMAL",
               "the cell " + vispline::quoted(cell) + " may hold a decimal comma or thousands",
               context.where_line(row.line), "pass --decimal , if the comma is the decimal mark");
}

/// Sets the decimal mark: a comma only if asked for, or if semicolons part the cells and no cell holds a point.
void find_decimal(ReadContext& context, const std::vector<HeadLine>& rows, TextLayout& layout) {
  layout.decimal = context.options().decimal;
  if (layout.separator == ',' || layout.decimal == ',') return;
  for (const HeadLine& row : rows) {
    for (const std::string& cell : cells_of(row.text, layout.separator)) {
      if (cell.find(',') == std::string::npos ||
          !std::any_of(cell.begin(), cell.end(), [](unsigned char c) { return std::isdigit(c) != 0; }))
        continue;
      const bool plain = is_decimal_comma(cell) && row.text.find('.') == std::string_view::npos;
      if (!plain || layout.separator != ';') {
        if (is_number_char(cell[0])) fail_decimal(context, row, cell);
        continue;
      }
      context.warn("W-DECIMAL", "the comma in " + vispline::quoted(cell) + " is read as decimal mark",
                   context.where_line(row.line), "all rows are read so, because ';' separates the cells",
                   "pass --decimal , to say so");
      layout.decimal = ',';
      return;
    }
  }
}

bool is_header(const std::vector<std::string>& cells, char decimal) {
  const auto words =
      std::count_if(cells.begin(), cells.end(), [&](const std::string& c) { return !is_numeric(c, decimal); });
  return words * 2 > static_cast<std::ptrdiff_t>(cells.size());
}

void drop_empty_last(std::vector<std::string>& cells) {
  if (cells.size() > 1 && cells.back().empty()) cells.pop_back();
}

/// The number of cells that most of the sampled rows have.
std::size_t usual_count(const std::vector<std::vector<std::string>>& sample) {
  std::map<std::size_t, int> votes;
  for (const auto& cells : sample) {
    ++votes[cells.size() > 1 && cells.back().empty() ? cells.size() - 1 : cells.size()];
  }
  return std::max_element(votes.begin(), votes.end(), [](auto& a, auto& b) { return a.second < b.second; })->first;
}

/// Names in the last comment line that has as many words as the rows have cells.
void find_comment_header(const std::vector<HeadLine>& comments, TextLayout& layout) {
  for (auto line = comments.rbegin(); line != comments.rend(); ++line) {
    std::string_view text = trimmed(line->text);
    text.remove_prefix(std::min(text.find_first_not_of("#% \t"), text.size()));
    for (const char separator : {layout.separator, ',', ' '}) {
      std::vector<std::string> names = cells_of(text, separator);
      drop_empty_last(names);
      if (names.size() != layout.fields || !is_header(names, '.')) continue;
      layout.header = names;
      layout.header_in_comment = true;
      return;
    }
  }
}

bool all_integers(const std::vector<std::vector<std::string>>& sample) {
  return std::all_of(sample.begin(), sample.end(), [](const auto& cells) {
    return std::all_of(cells.begin(), cells.end(), [](const std::string& cell) {
      return cell.find_first_not_of("0123456789+-") == std::string::npos;
    });
  });
}

/// Header and rows must agree unless it is only some rows that are bad.
void check_header(const ReadContext& context, const TextLayout& layout, const HeadLine& first_row, std::size_t usual) {
  const std::size_t names = layout.header.size();
  const bool agrees = std::any_of(layout.sample.begin(), layout.sample.end(), [&](const auto& cells) {
    return cells.size() == names || (cells.size() == names + 1 && cells.back().empty());
  });
  if (agrees) return;
  if (layout.separator == ',' && usual > names && all_integers(layout.sample)) {
    fail_decimal(context, first_row, layout.sample[0][0] + "," + layout.sample[0][1]);
  }
  context.fail(ExitCode::kInput, "E-COLUMNS",
               "the header names " + std::to_string(names) + " columns, the rows have " + std::to_string(usual),
               context.where_line(first_row.line), "mend the header or pass --columns");
}

[[noreturn]] void fail_empty(const ReadContext& context, const std::string& found) {
  context.fail(ExitCode::kInput, "E-EMPTY", "no " + context.noun() + ": " + found, context.path(),
               "check that the recording was written");
}

}  // namespace

TextLayout find_layout(ReadContext& context, std::string_view text) {
  Head head = read_head(context, text);
  if (head.rows.empty()) fail_empty(context, text.empty() ? "the file is empty" : "the file holds no row of numbers");
  TextLayout layout;
  layout.notes = std::move(head.notes);
  layout.separator = separator_of(head.rows[0].text, context.options().decimal);
  const std::vector<std::string> first = cells_of(head.rows[0].text, layout.separator);
  if (first.size() > limits::kFields) {
    context.fail(ExitCode::kLimit, "E-LIMIT", "a row has more than " + std::to_string(limits::kFields) + " cells",
                 context.where_line(head.rows[0].line), "check that this is a table of samples");
  }
  if (is_header(first, ',')) {
    layout.header = first;
    drop_empty_last(layout.header);
    head.rows.erase(head.rows.begin());
  }
  if (head.rows.empty()) fail_empty(context, "the file holds only a header");
  const HeadLine& last = head.rows.back();
  const bool last_is_cut = last.pos + last.text.size() == text.size();  // it may be: it must not vote
  if (head.rows.size() == 1 && last_is_cut) fail_empty(context, "the only row has no line end and may be cut");
  find_decimal(context, head.rows, layout);
  if (last_is_cut || head.rows.size() > kSampleRows) head.rows.pop_back();
  for (const HeadLine& row : head.rows) layout.sample.push_back(cells_of(row.text, layout.separator));
  layout.data_begin = head.rows[0].pos;
  layout.data_line = head.rows[0].line;
  layout.fields = usual_count(layout.sample);
  if (layout.header.empty()) {
    find_comment_header(head.comments, layout);
  } else {
    if (layout.separator == ' ' && layout.fields == 1) layout.header.resize(1);  // one name of several words
    check_header(context, layout, head.rows[0], layout.fields);
    layout.fields = layout.header.size();
  }
  return layout;
}

}  // namespace vispline

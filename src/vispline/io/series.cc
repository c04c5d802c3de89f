#include "vispline/io/series.h"

#include <cmath>
#include <limits>
#include <utility>

#include "vispline/io/read_end.h"
#include "vispline/io/row_stream.h"
#include "vispline/io/text_cells.h"

namespace vispline {
namespace {

constexpr const char* kNext = "pass --columns with value for the column to read and - for the others, such as -,value";

/// The column that holds the numbers.
int value_column(const ReadContext& context, std::size_t fields) {
  const std::string& columns = context.options().columns;
  if (columns.empty() && fields == 1) return 0;
  const std::vector<std::string_view> names = split_cells(columns, ',');
  if (columns.empty() || names.size() != fields) {
    context.fail(ExitCode::kInput, "E-COLUMNS",
                 "the file has " + std::to_string(fields) + " columns" +
                     (columns.empty() ? "" : ", --columns names " + std::to_string(names.size())),
                 context.path(), kNext);
  }
  int found = -1;
  bool unclear = false;
  for (std::size_t i = 0; i < names.size(); ++i) {
    unclear |= names[i] != "-" && (names[i] != "value" || found >= 0);
    if (names[i] == "value") found = static_cast<int>(i);
  }
  if (found < 0 || unclear) {
    context.fail(ExitCode::kUsage, "E-COLUMNS", "--columns must name one column value, and - for all others",
                 "--columns", kNext);
  }
  return found;
}

/// Missing numbers become nan in place.
std::vector<double> load(ReadContext& context, RowStream& rows) {
  std::vector<double> values;
  std::int64_t missing = 0, first_line = 0;
  for (TextRow row; rows.next(row);) {
    double value = row.values[0];
    if (!std::isfinite(value)) {
      if (missing++ == 0) first_line = row.line;
      value = std::numeric_limits<double>::quiet_NaN();
      context.warn("W-NONFINITE", "a value is missing, nan or inf", context.where_line(row.line),
                   "it stays in its place as nan");
    }
    values.push_back(value);
  }
  if (context.too_many(missing)) {
    context.fail(ExitCode::kUnfit, "E-NONFINITE", percent(context.share(missing)) + " of the values are nan or inf",
                 context.where_line(first_line), "pass --repair to go on with them as gaps");
  }
  return values;
}

}  // namespace

ReadResult<std::vector<double>> read_series(const std::string& path, const ReadOptions& options) {
  ReadContext context(path, "values", options);
  TextLines lines(context);
  const TextLayout layout = find_layout(context, lines.head(kHeadRows));
  lines.start_at(layout.data_begin, layout.data_line);
  RowStream rows(context, lines, layout, {.values = {value_column(context, layout.fields)}});
  std::vector<double> values = load(context, rows);
  if (values.empty()) fail_none_left(context);
  context.counts.kept = static_cast<std::int64_t>(values.size());
  check_strict(context);
  return {std::move(values), std::move(context.counts), std::move(context.diagnostics), "series", 0};
}

}  // namespace vispline

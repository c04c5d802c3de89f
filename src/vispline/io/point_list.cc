#include "vispline/io/feature_rows.h"
#include "vispline/io/features.h"
#include "vispline/io/read_end.h"

namespace vispline {

ReadResult<PointMap> read_points(const std::string& path, const ReadOptions& options) {
  require_feature_options(options);
  ReadContext context(path, "points", options);
  TextLines lines(context);
  const TextLayout layout = find_layout(context, lines.head(kHeadRows));
  if (layout.fields != 4) {
    context.fail(ExitCode::kInput, "E-COLUMNS",
                 "the rows have " + std::to_string(layout.fields) + " columns, expected id, x, y and z",
                 context.where_line(layout.data_line), "write one point a row");
  }
  lines.start_at(layout.data_begin, layout.data_line);
  RowStream rows(context, lines, layout, {.values = {0, 1, 2, 3}});
  PointMap points;
  for (TextRow row; rows.next(row);) {
    const Vector3d point(row.values[1], row.values[2], row.values[3]);
    const std::string where = context.where_line(row.line);
    if (!point.allFinite()) {
      context.fail(ExitCode::kInput, "E-NONFINITE", "a point is not finite", where, "mend the line");
    }
    if (!points.emplace(id_of(context, row.values[0], row.line), point).second) {
      context.fail(ExitCode::kInput, "E-DUPLICATE", "id " + brief(row.values[0]) + " comes twice", where,
                   "give every point its own id");
    }
  }
  if (points.empty()) fail_none_left(context);
  context.counts.kept = static_cast<std::int64_t>(points.size());
  check_strict(context);
  return {std::move(points), std::move(context.counts), std::move(context.diagnostics), "points"};
}

}  // namespace vispline

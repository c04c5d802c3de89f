#include <algorithm>
#include <cmath>
#include <map>

#include "vispline/io/feature_rows.h"
#include "vispline/io/features.h"
#include "vispline/io/read_end.h"
#include "vispline/io/stamp_screen.h"
#include "vispline/io/text_cells.h"

namespace vispline {
namespace {

struct Image {
  Decimal stamp;
  std::int64_t line = 0;
  std::vector<Feature> corners;
};

double number_of(const ReadContext& context, std::string_view cell, const TextLayout& layout, std::int64_t line) {
  std::string text(cell);
  if (layout.decimal == ',') std::ranges::replace(text, ',', '.');
  double value = 0.0;
  if (parse_double(text, value) == NumberStatus::kOk) return value;
  context.fail(ExitCode::kInput, "E-CSV", "the cell " + vispline::quoted(cell) + " is not a number",
               context.where_line(line), "mend the line");
}

bool is_unseen(const Vector2d& px) {
  return (px.x() == -1.0 && px.y() == -1.0) || (std::isnan(px.x()) && std::isnan(px.y()));
}

std::vector<Feature> corners_of(const ReadContext& context, std::string_view text, const TextLayout& layout,
                                std::int64_t line) {
  const std::vector<std::string_view> cells = split_cells(text, layout.separator);
  std::vector<Feature> corners;
  for (std::size_t i = 1; i + 1 < layout.fields; i += 2) {
    const Vector2d px(number_of(context, cells[i], layout, line), number_of(context, cells[i + 1], layout, line));
    if (is_unseen(px)) continue;
    if (!px.allFinite()) {
      context.fail(ExitCode::kInput, "E-CSV", "corner " + std::to_string(i / 2) + " is not finite",
                   context.where_line(line), "write -1,-1 for a corner that was not seen");
    }
    corners.push_back({i / 2, px});
  }
  return corners;
}

std::vector<Image> load(ReadContext& context, TextLines& lines, const TextLayout& layout) {
  RowStream rows(context, lines, layout, {.stamp = 0, .values = {}});
  std::vector<Image> images;
  for (TextRow row; rows.next(row);) {
    images.push_back({row.stamp, row.line, corners_of(context, rows.line(), layout, row.line)});
  }
  if (images.empty()) fail_none_left(context);
  return images;
}

/// The images by line, in the order and with the stamps that the screen lets pass.
FeatureSignal screened(ReadContext& context, const TextLayout& layout, std::vector<Image>& images) {
  std::vector<Decimal> stamps;
  std::map<std::int64_t, Image*> by_line;
  for (Image& image : images) {
    stamps.push_back(image.stamp);
    by_line[image.line] = &image;
  }
  const TimeUnit unit = feature_time_unit(context, layout, stamps);
  FeatureSignal signal;
  StampScreen screen(context, [&](std::span<const SensorRow> rows) {
    for (const SensorRow& row : rows) {
      signal.push_back(time_from_ns(row.ns), {});
      signal.value.back() = std::move(by_line.at(row.where)->corners);
    }
  });
  for (const Image& image : images) {
    const std::int64_t ns = to_nanoseconds(image.stamp, unit).value_or(kNoStamp);
    screen.push({.ns = ns, .where = image.line, .scientific = image.stamp.scientific});
  }
  screen.flush();
  screen.judge(unit.nanoseconds());
  context.counts.kept = static_cast<std::int64_t>(signal.size());
  if (signal.empty()) fail_none_left(context);
  return signal;
}

std::size_t columns_of(const std::string& path, const ReadOptions& options) {
  ReadContext context(path, "features", options);
  TextLines lines(context);
  return find_layout(context, lines.head(kHeadRows)).fields;
}

}  // namespace

ReadResult<FeatureSignal> read_corner_table(const std::string& path, const ReadOptions& options) {
  require_feature_options(options);
  ReadContext context(path, "images", options);
  TextLines lines(context);
  const TextLayout layout = find_layout(context, lines.head(kHeadRows));
  if (layout.fields < 3 || layout.fields % 2 == 0) {
    context.fail(ExitCode::kInput, "E-COLUMNS",
                 "the rows have " + std::to_string(layout.fields) + " columns, expected a stamp and pairs of u and v",
                 context.where_line(layout.data_line), "write one image a row");
  }
  lines.start_at(layout.data_begin, layout.data_line);
  std::vector<Image> images = load(context, lines, layout);
  FeatureSignal signal = screened(context, layout, images);
  check_strict(context);
  return {std::move(signal), std::move(context.counts), std::move(context.diagnostics), "corners"};
}

ReadResult<FeatureSignal> read_features(const std::string& path, const ReadOptions& options) {
  require_feature_options(options);
  return columns_of(path, options) == 4 ? read_tracks(path, options) : read_corner_table(path, options);
}

}  // namespace vispline

#include <algorithm>
#include <set>

#include "vispline/io/feature_rows.h"
#include "vispline/io/features.h"
#include "vispline/io/read_end.h"

namespace vispline {
namespace {

constexpr std::size_t kColumns = 4;

struct Observation {
  Decimal stamp;
  Feature feature;
  std::int64_t line = 0;
  std::int64_t ns = 0;
};

std::vector<Observation> load(ReadContext& context, TextLines& lines, const TextLayout& layout) {
  RowStream rows(context, lines, layout, {.stamp = 0, .values = {1, 2, 3}});
  std::vector<Observation> observations;
  std::int64_t lost = 0, first_lost = 0;
  for (TextRow row; rows.next(row);) {
    const Feature feature{id_of(context, row.values[0], row.line), {row.values[1], row.values[2]}};
    if (feature.px.allFinite()) {
      observations.push_back({row.stamp, feature, row.line});
    } else {
      context.drop("W-NONFINITE", "a pixel is not finite", context.where_line(row.line));
      if (lost++ == 0) first_lost = row.line;
    }
  }
  if (context.too_many(lost)) {
    context.fail(ExitCode::kUnfit, "E-NONFINITE", percent(context.share(lost)) + " of the pixels are not finite",
                 context.where_line(first_lost), "pass --repair to leave these rows out");
  }
  if (observations.empty()) fail_none_left(context);
  return observations;
}

/// In order of time; rows of one stamp stay in the order of the file.
void put_in_order(ReadContext& context, std::vector<Observation>& observations) {
  const auto earlier = [](const Observation& a, const Observation& b) { return a.ns < b.ns; };
  const auto sorted = std::is_sorted_until(observations.begin(), observations.end(), earlier);
  if (sorted == observations.end()) return;
  context.warn("W-ORDER", "a row is earlier than the one before it", context.where_line(sorted->line),
               "all rows are sorted by their stamps");
  std::stable_sort(observations.begin(), observations.end(), earlier);
}

void set_times(ReadContext& context, const TextLayout& layout, std::vector<Observation>& observations) {
  std::vector<Decimal> stamps;
  for (const Observation& row : observations) {
    const bool again =
        !stamps.empty() && stamps.back().whole == row.stamp.whole && stamps.back().nano == row.stamp.nano;
    if (!again) stamps.push_back(row.stamp);
  }
  const TimeUnit unit = feature_time_unit(context, layout, stamps);
  for (Observation& row : observations) {
    const auto ns = to_nanoseconds(row.stamp, unit);
    if (!ns) {
      context.fail(ExitCode::kInput, "E-TIME-RANGE", "a stamp is no time of 64 bits of nanoseconds",
                   context.where_line(row.line), "mend the line");
    }
    row.ns = *ns;
  }
}

FeatureSignal frames_of(ReadContext& context, const std::vector<Observation>& observations) {
  FeatureSignal signal;
  std::set<std::uint64_t> seen;
  for (const Observation& row : observations) {
    if (signal.empty() || to_ns(signal.time.back()) != row.ns) {
      signal.push_back(time_from_ns(row.ns), {});
      seen.clear();
    }
    if (seen.insert(row.feature.id).second) {
      signal.value.back().push_back(row.feature);
      ++context.counts.kept;
    } else {
      context.drop("W-DUPLICATE", "id " + std::to_string(row.feature.id) + " comes twice in one frame",
                   context.where_line(row.line));
    }
  }
  return signal;
}

}  // namespace

ReadResult<FeatureSignal> read_tracks(const std::string& path, const ReadOptions& options) {
  require_feature_options(options);
  ReadContext context(path, "observations", options);
  TextLines lines(context);
  const TextLayout layout = find_layout(context, lines.head(kHeadRows));
  if (layout.fields != kColumns) {
    context.fail(ExitCode::kInput, "E-COLUMNS",
                 "the rows have " + std::to_string(layout.fields) + " columns, expected timestamp, id, u and v",
                 context.where_line(layout.data_line), "write one observation a row");
  }
  lines.start_at(layout.data_begin, layout.data_line);
  std::vector<Observation> observations = load(context, lines, layout);
  set_times(context, layout, observations);
  put_in_order(context, observations);
  FeatureSignal signal = frames_of(context, observations);
  check_strict(context);
  return {std::move(signal), std::move(context.counts), std::move(context.diagnostics), "tracks"};
}

}  // namespace vispline

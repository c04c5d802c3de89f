#include "vispline/io/stamps.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <string>

namespace vispline {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kMaxIsolated = 3;  ///< outliers that never count as too many
constexpr double kRoundedShare = 0.2;     ///< duplicates above this share mean rounded stamps
constexpr std::int64_t kMaxStep = INT64_MAX / 2048;
constexpr double kWrap32 = 4294967296.0;

std::string at(std::int64_t ns) { return "t = " + brief_seconds(static_cast<double>(ns) * 1e-9); }

StampedRows in_range(ReadContext& context, const std::vector<Decimal>& stamps, const TimeUnit& unit) {
  StampedRows rows;
  rows.ns.reserve(stamps.size());
  rows.row.reserve(stamps.size());
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    const auto ns = to_nanoseconds(stamps[i], unit);
    if (ns && *ns >= 0) {
      rows.ns.push_back(*ns);
      rows.row.push_back(i);
    } else {
      context.drop("W-TIME-RANGE", ns ? "the stamp is negative" : "the stamp is no time of 64 bits in nanoseconds",
                   context.where_row(i));
    }
  }
  const auto lost = static_cast<std::int64_t>(stamps.size() - rows.size());
  if (context.too_many(lost)) {
    context.fail(ExitCode::kInput, "E-TIME-RANGE",
                 percent(context.share(lost)) + " of the stamps are negative or beyond 64 bits", context.path(),
                 "check the time column and --time-unit");
  }
  return rows;
}

/// Is entry i, out of order, the one stamp that is wrong? Then its neighbours leave its own place free; a row that only
/// stands in the wrong place leaves no hole.
bool leaves_hole(const std::vector<std::int64_t>& ns, std::size_t i, std::int64_t step) {
  const std::int64_t before = ns[i - 1], after = ns[i + 1];
  if (ns[i] >= before && ns[i] <= after) return false;
  return after - before > step + step / 2 && after - before <= 10 * step;
}

bool is_first_off(const std::vector<std::int64_t>& ns, std::int64_t step) {
  const std::int64_t far = std::max(kSecond, 1000 * step);
  const bool rest_agrees = ns[2] > ns[1] && ns[2] - ns[1] <= 10 * step;
  return rest_agrees && (ns[1] - ns[0] > far || ns[0] - ns[2] > kSecond);
}

bool is_last_off(const std::vector<std::int64_t>& ns, std::int64_t step) {
  const std::size_t n = ns.size();
  const std::int64_t far = std::max(kSecond, 1000 * step);
  const bool rest_agrees = ns[n - 2] > ns[n - 3] && ns[n - 2] - ns[n - 3] <= 10 * step;
  return rest_agrees && (ns[n - 1] - ns[n - 2] > far || ns[n - 2] - ns[n - 1] > kSecond);
}

void drop_outliers(ReadContext& context, StampedRows& rows, std::int64_t step) {
  const std::size_t n = rows.size();
  if (n < 4 || step == 0) return;
  std::vector<std::uint8_t> keep(n, 1);
  keep[0] = !is_first_off(rows.ns, step);
  keep[n - 1] = !is_last_off(rows.ns, step);
  for (std::size_t i = 1; i + 1 < n; ++i) keep[i] = !leaves_hole(rows.ns, i, step);
  const std::int64_t off = std::count(keep.begin(), keep.end(), 0);
  const bool isolated = off <= kMaxIsolated || context.share(off) <= kLoudLoss;
  if (off == 0 || !isolated) return;  // many of them: the order is broken, not a stamp
  for (std::size_t i = 0; i < n; ++i) {
    if (keep[i]) continue;
    context.drop("W-TIME-OUTLIER", "one stamp is off while its neighbours agree (" + at(rows.ns[i]) + ")",
                 context.where_row(rows.row[i]));
  }
  rows.keep(keep);
}

/// Few steps back, each by more than a second, with order in between: the clock was set back.
void check_reset(const ReadContext& context, const StampedRows& rows, const TimeUnit& unit) {
  std::size_t backs = 0, big = 0, first = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const std::int64_t step = rows.ns[i] - rows.ns[i - 1];
    backs += step < 0;
    if (step >= -kSecond) continue;
    if (big++ == 0) first = i;
  }
  if (big == 0 || backs > std::max<std::size_t>(1, rows.size() / 100)) return;
  const double back = static_cast<double>(rows.ns[first - 1] - rows.ns[first]);
  const double counts = back / unit.nanoseconds();
  const bool wraps = std::abs(counts - kWrap32) < 0.01 * kWrap32;
  context.fail(
      ExitCode::kInput, "E-TIME-RESET",
      "clock set back by " + brief_seconds(back * 1e-9) + " after sample " + std::to_string(first) + " (" +
          at(rows.ns[first - 1]) + ")" + (wraps ? "; the stamps wrap as a 32-bit counter does" : ""),
      context.where_row(rows.row[first]),
      "pass --segments to analyse the " + std::to_string(big + 1) + " parts apart, or choose one with --from/--to");
}

/// Fewest entries to move so that the stamps do not decrease: n minus the longest run in order (patience sorting).
std::size_t out_of_order(const std::vector<std::int64_t>& ns) {
  std::vector<std::int64_t> tails;
  for (const std::int64_t t : ns) {
    const auto place = std::upper_bound(tails.begin(), tails.end(), t);
    if (place == tails.end()) {
      tails.push_back(t);
    } else {
      *place = t;
    }
  }
  return ns.size() - tails.size();
}

void sort_rows(StampedRows& rows) {
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return rows.ns[a] < rows.ns[b]; });
  StampedRows sorted;
  for (const std::size_t i : order) {
    sorted.ns.push_back(rows.ns[i]);
    sorted.row.push_back(rows.row[i]);
  }
  rows = std::move(sorted);
}

void check_order(ReadContext& context, StampedRows& rows, const TimeUnit& unit) {
  const auto back = std::adjacent_find(rows.ns.begin(), rows.ns.end(), std::greater<>());
  if (back == rows.ns.end()) return;
  check_reset(context, rows, unit);
  const auto late = static_cast<std::int64_t>(out_of_order(rows.ns));
  const auto first = static_cast<std::size_t>(back - rows.ns.begin()) + 1;
  const std::string where = context.where_row(rows.row[first]);
  const std::string found = std::to_string(late) + " rows (" + percent(context.share(late)) +
                            ") are out of order; the first goes back by " +
                            brief_seconds(static_cast<double>(rows.ns[first - 1] - rows.ns[first]) * 1e-9);
  if (context.too_many(late)) {
    context.fail(ExitCode::kInput, "E-ORDER", found, where,
                 "sort the file by time, or pass --repair to have it sorted");
  }
  context.warn("W-ORDER", found, where, "all rows are kept, sorted by time");
  sort_rows(rows);
}

void drop_duplicates(ReadContext& context, StampedRows& rows, const std::vector<Decimal>& stamps, const SameRow& same) {
  if (std::adjacent_find(rows.ns.begin(), rows.ns.end()) == rows.ns.end()) return;
  std::vector<std::uint8_t> keep(rows.size(), 1);
  std::int64_t other = 0;
  std::size_t example = 0;
  for (std::size_t first = 0, i = 1; i < rows.size(); ++i) {
    if (rows.ns[i] != rows.ns[first]) {
      first = i;
      continue;
    }
    keep[i] = 0;
    const bool equal = same(rows.row[first], rows.row[i]);
    if (!equal && other++ == 0) example = i;
    context.drop("W-DUPLICATE",
                 std::string("a stamp stands twice, with ") + (equal ? "the same" : "other") + " values (" +
                     at(rows.ns[i]) + ")",
                 context.where_row(rows.row[i]));
  }
  const std::string found = percent(context.share(other)) + " of the rows repeat a stamp with other values";
  const std::string where = context.where_row(rows.row[example]);
  const bool rounded = context.share(other) > kRoundedShare || (other > 0 && stamps[rows.row[example]].scientific);
  if (rounded && !context.options().repair) {
    context.fail(ExitCode::kInput, "E-TIME-PRECISION", "the stamps are rounded: " + found, where,
                 "write the stamps with all their digits, or pass --time-unit index@RATE with --columns");
  }
  if (context.too_many(other)) {
    context.fail(ExitCode::kInput, "E-DUPLICATE", found, where,
                 "mend the file, or pass --repair to keep the first of each");
  }
  rows.keep(keep);
}

}  // namespace

void StampedRows::keep(const std::vector<std::uint8_t>& flags) {
  std::size_t out = 0;
  for (std::size_t i = 0; i < flags.size(); ++i) {
    if (!flags[i]) continue;
    ns[out] = ns[i];
    row[out++] = row[i];
  }
  ns.resize(out);
  row.resize(out);
}

std::int64_t median_step_ns(const std::vector<std::int64_t>& ns) {
  std::vector<std::int64_t> steps;
  const std::size_t stride = sampling_stride(ns.size());
  for (std::size_t i = 1; i < ns.size(); i += stride) {
    if (ns[i] != ns[i - 1]) steps.push_back(std::abs(ns[i] - ns[i - 1]));
  }
  if (steps.empty()) return 0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return std::min(*middle, kMaxStep);
}

StampedRows check_stamps(ReadContext& context, const std::vector<Decimal>& stamps, const TimeUnit& unit,
                         const SameRow& same) {
  StampedRows rows = in_range(context, stamps, unit);
  drop_outliers(context, rows, median_step_ns(rows.ns));
  check_order(context, rows, unit);
  drop_duplicates(context, rows, stamps, same);
  return rows;
}

}  // namespace vispline

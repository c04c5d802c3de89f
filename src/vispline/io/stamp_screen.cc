#include "vispline/io/stamp_screen.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>

namespace vispline {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::size_t kMaxIsolated = 3;  ///< outliers that never count as too many
constexpr double kRoundedShare = 0.2;    ///< duplicates above this share mean rounded stamps
constexpr double kWrap32 = 4294967296.0;

std::string at(std::int64_t ns) { return "t = " + brief_seconds(static_cast<double>(ns) * 1e-9); }

bool same_values(const SensorRow& a, const SensorRow& b) {
  return std::equal(a.values.begin(), a.values.end(), b.values.begin(),
                    [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

/// Is b, out of order between a and c, the one stamp that is wrong? Then its neighbours leave its own place free; a row
/// that only stands in the wrong place leaves no hole.
bool leaves_hole(std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t step) {
  if (b >= a && b <= c) return false;
  return c - a > step + step / 2 && c - a <= 10 * step;
}

bool agree(std::int64_t a, std::int64_t b, std::int64_t step) { return b > a && b - a <= 10 * step; }

bool is_first_off(std::int64_t first, std::int64_t second, std::int64_t third, std::int64_t step) {
  return agree(second, third, step) && (second - first > std::max(kSecond, 1000 * step) || first - third > kSecond);
}

bool is_last_off(std::int64_t a, std::int64_t b, std::int64_t last, std::int64_t step) {
  return agree(a, b, step) && (last - b > std::max(kSecond, 1000 * step) || b - last > kSecond);
}

bool is_increasing(std::span<const SensorRow> rows) {
  return std::adjacent_find(rows.begin(), rows.end(),
                            [](const SensorRow& a, const SensorRow& b) { return a.ns >= b.ns; }) == rows.end();
}

}  // namespace

StampScreen::StampScreen(ReadContext& context, Sink sink, std::size_t window)
    : context_(context), sink_(std::move(sink)), window_(window) {
  require(window >= 8, "a window of 8 rows or more");
}

void StampScreen::push(const SensorRow& row) {
  if (row.ns < 0) {
    ++out_of_range_;
    context_.drop("W-TIME-RANGE",
                  row.ns == kNoStamp
                      ? "the stamp is no time: beyond 64 bits of nanoseconds, or a second of 1e9 nanoseconds and more"
                      : "the stamp is negative",
                  context_.where_line(row.where));
    return;
  }
  ++in_range_;
  raw_in_order_ = raw_in_order_ && row.ns > last_raw_;
  add_step(row.ns);
  raw_.push_back(row);
  if (raw_.size() < window_) return;
  drop_outliers(false);
}

void StampScreen::flush() {
  drop_outliers(true);
  emit(waiting_.size());
}

void StampScreen::add_step(std::int64_t ns) {
  if (last_raw_ != kNoStamp && ns != last_raw_) steps_.add(std::abs(ns - last_raw_));
  last_raw_ = ns;
}

/// Tells an isolated stamp from its neighbours. Found again each time the rows have doubled.
std::int64_t StampScreen::recent_median_step() {
  if (steps_.count() >= 2 * steps_at_median_ && !steps_.empty()) {
    median_step_ = median_of_steps(steps_.values());
    steps_at_median_ = steps_.count();
  }
  return median_step_;
}

bool StampScreen::is_off(std::size_t i, std::int64_t step, bool last) const {
  const auto ns = [&](std::size_t k) { return raw_[k].ns; };
  if (at_start_ && i == 0) return is_first_off(ns(0), ns(1), ns(2), step);
  if (last && i + 1 == raw_.size()) return is_last_off(ns(i - 2), ns(i - 1), ns(i), step);
  return leaves_hole(ns(i - 1), ns(i), ns(i + 1), step);
}

/// Rows done_ .. stop - 1 that are off; none if they are many: then the order is broken, not a stamp.
std::vector<std::size_t> StampScreen::find_off(std::size_t stop, bool last) {
  std::vector<std::size_t> off;
  const std::int64_t step = recent_median_step();
  const bool none = raw_in_order_ && !last && !at_start_;
  if (none || in_range_ < 4 || step == 0) return off;
  for (std::size_t i = done_; i < stop; ++i) {
    if (is_off(i, step, last)) off.push_back(i);
  }
  const auto rows = static_cast<double>(std::min<std::int64_t>(in_range_, static_cast<std::int64_t>(window_)));
  const bool isolated = off.size() <= kMaxIsolated || static_cast<double>(off.size()) <= kLoudLoss * rows;
  if (!isolated) off.clear();
  return off;
}

/// Judges all rows whose neighbours are known, and passes on those that are not off.
void StampScreen::drop_outliers(bool last) {
  largest_ = std::max(largest_, raw_.size() + waiting_.size());
  const std::size_t stop = last ? raw_.size() : raw_.size() - 1;
  const std::span<const SensorRow> rows(raw_);
  std::size_t begin = done_;
  for (const std::size_t i : find_off(stop, last)) {
    context_.drop("W-TIME-OUTLIER", "one stamp is off while its neighbours agree (" + at(raw_[i].ns) + ")",
                  context_.where_line(raw_[i].where));
    arrive(rows.subspan(begin, i - begin));
    begin = i + 1;
  }
  arrive(rows.subspan(begin, stop - begin));
  const std::size_t keep = std::min<std::size_t>(raw_.size(), 3);
  raw_.erase(raw_.begin(), raw_.end() - static_cast<std::ptrdiff_t>(keep));
  raw_in_order_ = is_increasing(raw_);
  done_ = keep - (last ? 0 : 1);
  at_start_ = false;
}

void StampScreen::Back::add(std::int64_t at_index, const SensorRow& row, std::int64_t before_ns) {
  if (count++ > 0) return;
  index = at_index;
  where = row.where;
  before = before_ns;
  after = row.ns;
}

/// A block in order is taken as a whole.
void StampScreen::arrive(std::span<const SensorRow> rows) {
  if (rows.empty()) return;
  const std::int64_t newest = waiting_.empty() ? (kept_ > 0 ? group_.ns : 0) : waiting_.back().ns;
  if (raw_in_order_ && sorted_ && rows.front().ns >= std::max(newest, last_arrived_)) {
    waiting_.insert(waiting_.end(), rows.begin(), rows.end());
    for (const SensorRow& row : rows) tails_.push_back(row.ns);
    arrived_ += static_cast<std::int64_t>(rows.size());
    last_arrived_ = rows.back().ns;
  } else {
    for (const SensorRow& row : rows) arrive_alone(row);
  }
  while (waiting_.size() >= 2 * window_) emit(window_);
}

void StampScreen::arrive_alone(const SensorRow& row) {
  if (arrived_ > 0 && row.ns < last_arrived_) {
    backs_.add(arrived_, row, last_arrived_);
    if (row.ns - last_arrived_ < -kSecond) resets_.add(arrived_, row, last_arrived_);
  }
  ++arrived_;
  last_arrived_ = row.ns;
  if (kept_ > 0 && row.ns < group_.ns) {
    ++too_late_;
    return;
  }
  extend_run(row.ns);
  sorted_ = sorted_ && (waiting_.empty() || row.ns >= waiting_.back().ns);
  waiting_.push_back(row);
}

void StampScreen::extend_run(std::int64_t ns) {
  if (tails_.empty() || ns >= tails_.back()) {
    tails_.push_back(ns);
  } else {
    *std::upper_bound(tails_.begin(), tails_.end(), ns) = ns;
  }
}

/// The first `count` rows in order of time leave the window.
void StampScreen::emit(std::size_t count) {
  largest_ = std::max(largest_, raw_.size() + waiting_.size());
  if (!sorted_) {
    std::stable_sort(waiting_.begin(), waiting_.end(),
                     [](const SensorRow& a, const SensorRow& b) { return a.ns < b.ns; });
    sorted_ = true;
  }
  const std::span<const SensorRow> leaving = std::span<const SensorRow>(waiting_).first(count);
  const bool distinct = is_increasing(leaving) && (kept_ == 0 || count == 0 || leaving.front().ns > group_.ns);
  if (!distinct) {
    drop_duplicates(leaving);
  } else if (count > 0) {
    group_ = leaving.back();
    kept_ += static_cast<std::int64_t>(count);
    sink_(leaving);
  }
  waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(count));
  const auto final_tails = std::upper_bound(tails_.begin(), tails_.end(), group_.ns);
  in_order_ += final_tails - tails_.begin();
  tails_.erase(tails_.begin(), final_tails);
}

void StampScreen::drop_duplicates(std::span<const SensorRow> rows) {
  std::vector<SensorRow> distinct;
  for (const SensorRow& row : rows) {
    if (kept_ == 0 || row.ns != group_.ns) {
      distinct.push_back(row);
      group_ = row;
      ++kept_;
      continue;
    }
    const bool equal = same_values(group_, row);
    if (!equal && other_values_++ == 0) other_example_ = row;
    context_.drop(
        "W-DUPLICATE",
        std::string("a stamp stands twice, with ") + (equal ? "the same" : "other") + " values (" + at(row.ns) + ")",
        context_.where_line(row.where));
  }
  if (!distinct.empty()) sink_(distinct);
}

void StampScreen::judge(double unit_ns) {
  judge_range();
  judge_reset(unit_ns);
  judge_order();
  judge_duplicates();
}

void StampScreen::judge_range() const {
  if (!context_.too_many(out_of_range_)) return;
  context_.fail(ExitCode::kInput, "E-TIME-RANGE",
                percent(context_.share(out_of_range_)) + " of the stamps are negative or beyond 64 bits",
                context_.path(), "check the time column and --time-unit");
}

/// Few steps back, one of them by more than a second, with order in between: the clock was set back.
void StampScreen::judge_reset(double unit_ns) const {
  if (resets_.count == 0 || backs_.count > std::max<std::int64_t>(1, arrived_ / 100)) return;
  const auto back = static_cast<double>(resets_.before - resets_.after);
  const bool wraps = std::abs(back / unit_ns - kWrap32) < 0.01 * kWrap32;
  context_.fail(ExitCode::kInput, "E-TIME-RESET",
                "clock set back by " + brief_seconds(back * 1e-9) + " after sample " + std::to_string(resets_.index) +
                    " (" + at(resets_.before) + ")" + (wraps ? "; the stamps wrap as a 32-bit counter does" : ""),
                context_.where_line(resets_.where),
                "pass --segments to analyse the " + std::to_string(resets_.count + 1) +
                    " parts apart, or choose one with --from/--to");
}

void StampScreen::judge_order() {
  const std::int64_t late = arrived_ - in_order_;
  if (late == 0) return;
  const std::string where = context_.where_line(backs_.where);
  const std::string found = std::to_string(late) + " rows (" + percent(context_.share(late)) +
                            ") are out of order; the first goes back by " +
                            brief_seconds(static_cast<double>(backs_.before - backs_.after) * 1e-9);
  if (too_late_ > 0) {
    context_.fail(
        ExitCode::kInput, "E-ORDER",
        found + "; " + std::to_string(too_late_) + " of them come later than " + std::to_string(window_) + " others",
        where, "sort the file by time");
  }
  if (context_.too_many(late)) {
    context_.fail(ExitCode::kInput, "E-ORDER", found, where,
                  "sort the file by time, or pass --repair to have it sorted");
  }
  context_.warn("W-ORDER", found, where, "all rows are kept, sorted by time");
}

void StampScreen::judge_duplicates() const {
  if (other_values_ == 0) return;
  const std::string found = percent(context_.share(other_values_)) + " of the rows repeat a stamp with other values";
  const std::string where = context_.where_line(other_example_.where);
  const bool rounded = context_.share(other_values_) > kRoundedShare || other_example_.scientific;
  if (rounded && !context_.options().repair) {
    context_.fail(ExitCode::kInput, "E-TIME-PRECISION", "the stamps are rounded: " + found, where,
                  "write the stamps with all their digits, or pass --time-unit index@RATE with --columns");
  }
  if (context_.too_many(other_values_)) {
    context_.fail(ExitCode::kInput, "E-DUPLICATE", found, where,
                  "mend the file, or pass --repair to keep the first of each");
  }
}

}  // namespace vispline

#include "vispline/io/timed_rows.h"

#include <cmath>
#include <string>
#include <utility>

namespace vispline {
namespace {

constexpr TimeUnit kSeconds{.kind = TimeUnit::Kind::kSeconds};

[[noreturn]] void fail_flags(const std::string& message, const std::string& next) {
  throw Error(ExitCode::kUsage,
              {.code = "E-ARGUMENT", .message = message, .where = "--rate", .effect = "nothing read", .next = next});
}

[[noreturn]] void fail_no_times(const ReadContext& context, bool counts) {
  context.fail(ExitCode::kInput, "E-TIME-UNIT",
               counts ? "the file counts samples, it has no column of times" : "the file has no column of times",
               context.path(),
               "pass --rate with the rate in Hz, or --time-unit index@RATE, such as index@200 or index@2000/7");
}

SampleClock clock_of(const ReadOptions& options, bool has_times) {
  if (!std::isfinite(options.rate_hz) || options.rate_hz < 0.0) {
    fail_flags("the rate is " + brief(options.rate_hz) + " Hz", "pass a rate above 0 Hz");
  }
  if (!options.time_unit.empty()) fail_flags("both a rate and a unit of time are given", "leave out one of them");
  if (has_times) {
    fail_flags("a rate is given, but the file has a column of times",
               "leave out --rate, or pass --columns with - for the times");
  }
  return {.start = Time{}, .rate_hz = options.rate_hz};
}

/// The stamp of a sample that is counted; kNoStamp beyond 64 bits.
std::int64_t clocked(const SampleClock& clock, const Decimal& count) {
  if (count.nano != 0 || count.whole == kNoStamp) return kNoStamp;
  if (std::abs(static_cast<double>(count.whole) * 1e9 / clock.rate_hz) > 9e18) return kNoStamp;
  return to_ns(clock(count.whole));
}

}  // namespace

StampPlan plan_stamps(const ReadContext& context, const ColumnPlan& plan) {
  const ReadOptions& options = context.options();
  const bool one = plan.column[kTimeColumn] >= 0, pair = !one && plan.column[kSecColumn] >= 0;
  StampPlan stamps{.column = plan.column[one ? kTimeColumn : kSecColumn], .declared = plan.time_unit};
  if (pair) {
    stamps.nano_column = plan.column[kNsecColumn];
    stamps.declared = kSeconds;
  }
  if (options.rate_hz != 0.0) stamps.clock = clock_of(options, one || pair);
  if (!options.time_unit.empty()) stamps.given = parse_time_unit(options.time_unit);
  stamps.counts = stamps.clock || (stamps.given && stamps.given->kind == TimeUnit::Kind::kIndex);
  if (!stamps.counts && !one && !pair) fail_no_times(context, plan.column[kIndexColumn] >= 0);
  if (stamps.counts) {
    stamps.column = plan.column[kIndexColumn];
    stamps.nano_column = -1;
  }
  return stamps;
}

TimedRows::TimedRows(ReadContext& context, TextLines& lines, const TextLayout& layout, const StampPlan& stamps,
                     std::vector<int> values, std::size_t window)
    : context_(context),
      stamps_(stamps),
      rows_(context, lines, layout,
            {.stamp = stamps.column, .stamp_nano = stamps.nano_column, .values = std::move(values)}),
      window_(window),
      unit_(stamps.given) {}

/// Reads the first rows, until they tell the unit of time.
void TimedRows::settle() {
  std::vector<Decimal> stamps;
  for (TextRow row; first_.size() < window_ && rows_.next(row);) {
    first_.push_back(row);
    stamps.push_back(row.stamp);
  }
  told_ = first_.size() < window_;
  unit_ = settle_time_unit(context_, stamps, told_, stamps_.declared);
}

bool TimedRows::next(SensorRow& row) {
  if (!unit_ && !stamps_.clock) settle();
  if (first_given_ < first_.size()) {
    row = timed(first_[first_given_++]);
    return true;
  }
  first_.clear();
  first_given_ = 0;
  TextRow text;
  if (!rows_.next(text)) return false;
  row = timed(text);
  return true;
}

SensorRow TimedRows::timed(const TextRow& row) const {
  Decimal stamp = row.stamp;
  if (stamps_.column < 0) stamp = {.whole = row.index, .nano = 0, .scientific = false};
  const std::int64_t ns =
      stamps_.clock ? clocked(*stamps_.clock, stamp) : to_nanoseconds(stamp, *unit_).value_or(kNoStamp);
  return {.ns = ns, .values = row.values, .where = row.line, .scientific = stamp.scientific};
}

void TimedRows::check_constant(const StampScreen& screen) const {
  if (told_ || screen.rows_in_range() < 2 || screen.rows_kept() != 1) return;
  fail_constant_time(context_, screen.rows_in_range());
}

void TimedRows::check_step(const StampScreen& screen) const {
  if (!told_) check_time_step(context_, static_cast<double>(screen.median_step()), *unit_);
}

}  // namespace vispline

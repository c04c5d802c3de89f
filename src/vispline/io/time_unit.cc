#include "vispline/io/time_unit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "vispline/io/text_row.h"

namespace vispline {
namespace {

using Kind = TimeUnit::Kind;
constexpr double kMinRate = 1.0, kMaxRate = 1e5;
/// Nanosecond stamps since 1970 are above this, stamps in seconds never.
constexpr std::int64_t kEpochNanoseconds = 100'000'000'000'000'000;

struct NamedUnit {
  std::string_view name;
  Kind kind;
};

constexpr std::array kUnits = {
    NamedUnit{"s", Kind::kSeconds},
    NamedUnit{"sec", Kind::kSeconds},
    NamedUnit{"secs", Kind::kSeconds},
    NamedUnit{"second", Kind::kSeconds},
    NamedUnit{"seconds", Kind::kSeconds},
    NamedUnit{"ms", Kind::kMilliseconds},
    NamedUnit{"msec", Kind::kMilliseconds},
    NamedUnit{"millisec", Kind::kMilliseconds},
    NamedUnit{"us", Kind::kMicroseconds},
    NamedUnit{"usec", Kind::kMicroseconds},
    NamedUnit{"microsec", Kind::kMicroseconds},
    NamedUnit{"ns", Kind::kNanoseconds},
    NamedUnit{"nsec", Kind::kNanoseconds},
    NamedUnit{"nanosec", Kind::kNanoseconds},
    NamedUnit{"nanoseconds", Kind::kNanoseconds},
};

[[noreturn]] void fail_flag(const std::string& text) {
  throw Error(ExitCode::kUsage, {.code = "E-TIME-UNIT",
                                 .message = "unknown time unit " + vispline::quoted(text),
                                 .where = "--time-unit",
                                 .effect = "nothing read",
                                 .next = "pass s, ms, us, ns or index@RATE with RATE in Hz, such as 200 or 2000/7"});
}

/// A positive decimal as a ratio of integers: 99.32 is 9932 / 100.
bool parse_ratio(const std::string& text, std::int64_t& numerator, std::int64_t& denominator) {
  Decimal value;
  if (parse_decimal(text, value) != NumberStatus::kOk || value.whole < 0 || value.whole > 1'000'000'000) return false;
  numerator = value.whole;
  denominator = 1;
  for (std::int64_t rest = value.nano, place = 100'000'000; rest > 0; rest %= place, place /= 10) {
    if (denominator > 100'000) return false;
    numerator = numerator * 10 + rest / place;
    denominator *= 10;
  }
  return numerator > 0;
}

std::int64_t rounded_quotient(std::int64_t value, std::int64_t divisor) { return (value + divisor / 2) / divisor; }

std::optional<std::int64_t> scaled(const Decimal& stamp, std::int64_t ns_per_unit) {
  std::int64_t whole = 0, sum = 0;
  const std::int64_t part = rounded_quotient(stamp.nano, 1'000'000'000 / ns_per_unit);
  if (__builtin_mul_overflow(stamp.whole, ns_per_unit, &whole) || __builtin_add_overflow(whole, part, &sum)) return {};
  return sum;
}

std::optional<std::int64_t> from_index(const Decimal& stamp, const TimeUnit& unit) {
  if (stamp.nano != 0) return {};
  __int128 wide = static_cast<__int128>(stamp.whole) * 1'000'000'000;
  if (__builtin_mul_overflow(wide, static_cast<__int128>(unit.rate_denominator), &wide)) return {};
  const __int128 half = wide < 0 ? -(unit.rate_numerator / 2) : unit.rate_numerator / 2;
  const __int128 ns = (wide + half) / unit.rate_numerator;
  if (ns > std::numeric_limits<std::int64_t>::max() || ns < std::numeric_limits<std::int64_t>::min()) return {};
  return static_cast<std::int64_t>(ns);
}

/// |b - a| in the unit of the file; near stamps to the nanosecond, whatever their size.
double step_between(const Decimal& a, const Decimal& b) {
  std::int64_t whole = 0;
  if (__builtin_sub_overflow(b.whole, a.whole, &whole)) return std::numeric_limits<double>::max();
  return std::abs(static_cast<double>(whole) + 1e-9 * (b.nano - a.nano));
}

bool is_before(const Decimal& a, const Decimal& b) { return a.whole != b.whole ? a.whole < b.whole : a.nano < b.nano; }

/// Steps that are not zero, in the unit of the file.
std::vector<double> steps_of(const std::vector<Decimal>& stamps, std::size_t& backward) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    if (stamps[i].whole == kNoStamp || stamps[i - 1].whole == kNoStamp) continue;
    const double step = step_between(stamps[i - 1], stamps[i]);
    if (step != 0.0) steps.push_back(step);
    backward += is_before(stamps[i], stamps[i - 1]);
  }
  return steps;
}

/// Median of the steps in order of time; 0 if all stamps are equal.
double median_step(const std::vector<Decimal>& stamps) {
  std::size_t backward = 0;
  std::vector<double> steps = steps_of(stamps, backward);
  if (steps.empty()) return 0.0;
  if (backward * 10 > steps.size()) {
    std::vector<Decimal> sorted = stamps;
    std::sort(sorted.begin(), sorted.end(), is_before);
    steps = steps_of(sorted, backward);
  }
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

bool is_plausible(double step, const TimeUnit& unit) {
  const double rate = 1e9 / (step * unit.nanoseconds());
  return rate >= kMinRate * 0.99 && rate <= kMaxRate * 1.01;
}

/// "ms (200 Hz) or us (...)": every unit that makes the rate plausible.
std::string guesses(double step) {
  std::string text;
  for (const auto& [name, kind] : {NamedUnit{"s", Kind::kSeconds}, NamedUnit{"ms", Kind::kMilliseconds},
                                   NamedUnit{"us", Kind::kMicroseconds}, NamedUnit{"ns", Kind::kNanoseconds}}) {
    const TimeUnit unit{.kind = kind};
    if (!is_plausible(step, unit)) continue;
    text += (text.empty() ? "" : " or ") + std::string(name) + " (" + brief(1e9 / (step * unit.nanoseconds())) + " Hz)";
  }
  return text.empty() ? "no unit fits" : "looks like " + text;
}

[[noreturn]] void fail_step(const ReadContext& context, double step, const TimeUnit& unit) {
  context.fail(ExitCode::kInput, "E-TIME-UNIT",
               "the stamps step by " + brief(step) + ", which is " + brief(1e9 / (step * unit.nanoseconds())) +
                   " Hz in the unit assumed; it " + guesses(step),
               context.path(), "pass --time-unit s, ms, us, ns or index@RATE");
}

[[noreturn]] void fail_range(const ReadContext& context, std::size_t beyond, std::size_t stamps) {
  context.fail(
      ExitCode::kInput, "E-TIME-RANGE",
      std::to_string(beyond) + " of " + std::to_string(stamps) + " stamps are no times of 64 bits of nanoseconds",
      context.path(), "give stamps below 2262, in s, ms, us or ns");
}

}  // namespace

double TimeUnit::nanoseconds() const {
  switch (kind) {
    case Kind::kSeconds:
      return 1e9;
    case Kind::kMilliseconds:
      return 1e6;
    case Kind::kMicroseconds:
      return 1e3;
    case Kind::kNanoseconds:
      return 1.0;
    case Kind::kIndex:
      return 1e9 * static_cast<double>(rate_denominator) / static_cast<double>(rate_numerator);
  }
  return 1.0;
}

TimeUnit parse_time_unit(const std::string& text) {
  if (const auto unit = time_unit_named(text)) return *unit;
  constexpr std::string_view kPrefix = "index@";
  if (!text.starts_with(kPrefix)) fail_flag(text);
  const std::string rate = text.substr(kPrefix.size());
  const std::size_t slash = std::min(rate.find('/'), rate.size());
  TimeUnit unit{.kind = Kind::kIndex};
  std::int64_t up = 1, down = 1;
  if (!parse_ratio(rate.substr(0, slash), unit.rate_numerator, unit.rate_denominator)) fail_flag(text);
  if (slash < rate.size() && !parse_ratio(rate.substr(slash + 1), up, down)) fail_flag(text);
  if (__builtin_mul_overflow(unit.rate_numerator, down, &unit.rate_numerator)) fail_flag(text);
  if (__builtin_mul_overflow(unit.rate_denominator, up, &unit.rate_denominator)) fail_flag(text);
  return unit;
}

std::optional<TimeUnit> time_unit_named(std::string_view name) {
  for (const NamedUnit& unit : kUnits) {
    if (unit.name == name) return TimeUnit{.kind = unit.kind};
  }
  return std::nullopt;
}

std::optional<std::int64_t> to_nanoseconds(const Decimal& stamp, const TimeUnit& unit) {
  if (stamp.whole == kNoStamp) return std::nullopt;
  switch (unit.kind) {
    case Kind::kSeconds:
      return scaled(stamp, 1'000'000'000);
    case Kind::kMilliseconds:
      return scaled(stamp, 1'000'000);
    case Kind::kMicroseconds:
      return scaled(stamp, 1'000);
    case Kind::kNanoseconds:
      return scaled(stamp, 1);
    case Kind::kIndex:
      return from_index(stamp, unit);
  }
  return std::nullopt;
}

TimeUnit settle_time_unit(const ReadContext& context, const std::vector<Decimal>& stamps, bool all,
                          std::optional<TimeUnit> declared) {
  if (stamps.size() < 2) return declared.value_or(TimeUnit{});
  const auto beyond = static_cast<std::size_t>(std::ranges::count(stamps, kNoStamp, &Decimal::whole));
  if (2 * beyond > stamps.size()) fail_range(context, beyond, stamps.size());
  const double step = median_step(stamps);
  const bool epoch_ns = stamps[stamps.size() / 2].whole > kEpochNanoseconds;
  const TimeUnit assumed = declared.value_or(TimeUnit{.kind = epoch_ns ? Kind::kNanoseconds : Kind::kSeconds});
  if (step > 0.0) {
    if (!is_plausible(step, assumed)) fail_step(context, step, assumed);
  } else if (all) {
    fail_constant_time(context, static_cast<std::int64_t>(stamps.size()));
  }
  return assumed;
}

void check_time_step(const ReadContext& context, double step_ns, const TimeUnit& unit) {
  const double step = step_ns / unit.nanoseconds();
  if (!is_plausible(step, unit)) fail_step(context, step, unit);
}

void fail_constant_time(const ReadContext& context, std::int64_t stamps) {
  context.fail(ExitCode::kInput, "E-TIME-CONSTANT", "all " + std::to_string(stamps) + " stamps are equal",
               context.path(), "pass --time-unit index@RATE with --columns if the rows are evenly spaced");
}

}  // namespace vispline

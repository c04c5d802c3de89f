/// What the numbers of a stamp column count.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vispline/io/number_text.h"
#include "vispline/io/read_context.h"

namespace vispline {

/// A unit of time, or samples at a rate of numerator / denominator Hz.
struct TimeUnit {
  enum class Kind { kSeconds, kMilliseconds, kMicroseconds, kNanoseconds, kIndex };
  Kind kind = Kind::kSeconds;
  std::int64_t rate_numerator = 1;
  std::int64_t rate_denominator = 1;

  /// Nanoseconds in one unit.
  double nanoseconds() const;
  friend bool operator==(const TimeUnit&, const TimeUnit&) = default;
};

/// "s", "ms", "us", "ns" or "index@RATE" with RATE in Hz written as 200, 99.32 or 2000/7. Throws E-TIME-UNIT (exit 2).
TimeUnit parse_time_unit(const std::string& text);

/// The unit a column name carries: [ns], [nanosec], (s); empty if it is not known.
std::optional<TimeUnit> time_unit_named(std::string_view name);

/// Nearest nanosecond, exact arithmetic; empty beyond 64 bits or for kNoStamp.
std::optional<std::int64_t> to_nanoseconds(const Decimal& stamp, const TimeUnit& unit);

/// Checks a unit that the format or the header declares, or finds it: seconds or nanoseconds if the implied rate leaves
/// no doubt. `stamps` are the first of the file; `all`: there are no others. Throws E-TIME-UNIT with a guess if the
/// implied rate is outside 1 Hz .. 100 kHz, E-TIME-CONSTANT if all stamps of the file are equal.
TimeUnit settle_time_unit(const ReadContext& context, const std::vector<Decimal>& stamps, bool all,
                          std::optional<TimeUnit> declared);

/// The same for the median step of a whole file, which its first rows may not have shown.
void check_time_step(const ReadContext& context, double step_ns, const TimeUnit& unit);

/// All of several stamps are equal.
[[noreturn]] void fail_constant_time(const ReadContext& context, std::int64_t stamps);

}  // namespace vispline

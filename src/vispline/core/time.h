/// Time is an integer number of nanoseconds on the recording's own clock; seconds are for differences only.
/// docs/conventions.md, Time.
#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>

namespace vispline {

/// The clock of a recording. It has no now(): stamps come from files or from a SampleClock.
struct SensorClock {
  using duration = std::chrono::nanoseconds;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<SensorClock>;
  static constexpr bool is_steady = true;
};

using Time = SensorClock::time_point;
using Duration = std::chrono::nanoseconds;

constexpr Time time_from_ns(std::int64_t ns) { return Time(Duration(ns)); }
constexpr std::int64_t to_ns(Time time) { return time.time_since_epoch().count(); }
constexpr double to_seconds(Duration duration) { return static_cast<double>(duration.count()) * 1e-9; }

/// The nearest nanosecond; |seconds| must stay below 292 years.
inline Duration from_seconds(double seconds) { return Duration(std::llround(seconds * 1e9)); }

/// A closed interval [begin, end].
struct TimeSpan {
  Time begin{};
  Time end{};
  bool contains(Time time) const { return begin <= time && time <= end; }
  double seconds() const { return to_seconds(end - begin); }
};

/// Stamps of a periodic sensor: an index times a period, so that a day of samples does not drift.
struct SampleClock {
  Time start{};
  double rate_hz = 200.0;

  Time operator()(std::int64_t index) const {
    return start + Duration(std::llround(static_cast<double>(index) * 1e9 / rate_hz));
  }
  /// Number of samples in the half-open interval [start, start + duration).
  std::int64_t count(Duration duration) const {
    auto n = static_cast<std::int64_t>(std::ceil(to_seconds(duration) * rate_hz));
    while (n > 0 && (*this)(n - 1) >= start + duration) --n;
    while ((*this)(n) < start + duration) ++n;
    return n;
  }
};

}  // namespace vispline

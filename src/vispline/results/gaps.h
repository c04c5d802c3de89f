/// Sampling gaps, and what to say when two records share no time. docs/math/evaluate.md (1).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "vispline/core/time.h"

namespace vispline {

/// Median of the steps between successive stamps, in seconds; 0 for fewer than two stamps.
double median_period_s(const std::vector<Time>& time);

/// The longest step that is bridged: max(periods * median period, floor_s).   docs/math/evaluate.md (1)
double gap_limit_s(const std::vector<Time>& time, double periods, double floor_s);

/// Seconds with nine decimals, exact to the nanosecond.
std::string seconds_text(Time time);

/// Throws Error(kUnfit, "E-OVERLAP") with both spans. `first` and `second` name the two records.
[[noreturn]] void throw_no_overlap(std::string_view first, TimeSpan first_span, std::string_view second,
                                   TimeSpan second_span, std::string next);

}  // namespace vispline

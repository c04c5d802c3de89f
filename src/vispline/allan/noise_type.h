/// Which power law rules a phase at one averaging factor, from its lag-1 autocorrelation.
/// W. Riley, C. Greenhall, Power law noise identification using the lag 1 autocorrelation, EFTF 2004.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace vispline {

/// alpha from 2 (white phase) to -4, of the phase taken every m-th point; empty below kFewestForNoiseType points.
std::optional<int> noise_alpha(std::span<const double> phase, std::int64_t m);

inline constexpr std::int64_t kFewestForNoiseType = 30;

}  // namespace vispline

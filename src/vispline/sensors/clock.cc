#include "vispline/sensors/clock.h"

#include <cmath>

#include "vispline/core/error.h"

namespace vispline {

ClockModel clock_of(const ClockModels& clocks, const std::string& sensor) {
  constexpr double kMostDrift = 0.01;
  const auto found = clocks.find(sensor);
  if (found == clocks.end()) return {};
  const ClockModel& clock = found->second;
  require(std::isfinite(clock.phase_s) && clock.phase_s >= 0.0, "a phase that is finite and not negative");
  require(std::abs(clock.drift) < kMostDrift, "a clock drift below 0.01 s/s");
  return clock;
}

}  // namespace vispline

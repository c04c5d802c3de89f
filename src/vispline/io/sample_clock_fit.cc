#include "vispline/io/sample_clock_fit.h"

#include <algorithm>
#include <cmath>

namespace vispline {

std::optional<FittedClock> fit_clock(std::span<const ClockPoint> points) {
  if (points.empty()) return std::nullopt;
  const ClockPoint origin = points.front();
  double mean_index = 0.0, mean_time = 0.0;
  for (const ClockPoint& point : points) {
    mean_index += static_cast<double>(point.index - origin.index) / static_cast<double>(points.size());
    mean_time += (point.seconds - origin.seconds) / static_cast<double>(points.size());
  }
  double square = 0.0, cross = 0.0;
  for (const ClockPoint& point : points) {
    const double index = static_cast<double>(point.index - origin.index) - mean_index;
    square += index * index;
    cross += index * (point.seconds - origin.seconds - mean_time);
  }
  if (square <= 0.0) return std::nullopt;
  FittedClock clock;
  clock.period_s = cross / square;
  clock.start_s = origin.seconds + mean_time - clock.period_s * (mean_index + static_cast<double>(origin.index));
  for (const ClockPoint& point : points) {
    const double off = point.seconds - clock.start_s - clock.period_s * static_cast<double>(point.index);
    clock.largest_s = std::max(clock.largest_s, std::abs(off));
  }
  return clock;
}

}  // namespace vispline

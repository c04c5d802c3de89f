/// The clock of samples that are stamped in blocks: a straight line through (index, time). Nominal rates are off by per
/// cent (200 Hz measured 197.5), and one stamp a second is too few to give each block its own rate.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace vispline {

struct ClockPoint {
  std::int64_t index = 0;  ///< of a sample, from the start of the recording
  double seconds = 0.0;    ///< when it was taken
};

struct FittedClock {
  double start_s = 0.0;    ///< time of sample 0
  double period_s = 0.0;   ///< of one sample
  double largest_s = 0.0;  ///< largest distance of a point from the line
};

/// Least squares. Empty for fewer than two indices that differ.
std::optional<FittedClock> fit_clock(std::span<const ClockPoint> points);

}  // namespace vispline

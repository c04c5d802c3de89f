/// When a sensor is sampled: by a clock, or at given stamps.
#pragma once

#include <cstddef>
#include <vector>

#include "vispline/core/time.h"

namespace vispline {

class Stamps {
 public:
  /// The samples of `clock` in [start, start + duration). Throws Error(kUsage) unless 0 < rate_hz <= 1e8 and the
  /// duration is positive.
  Stamps(SampleClock clock, Duration duration);
  /// Given stamps, as they are. Throws Error: E-TOO-SHORT (kUnfit) for fewer than two, E-ORDER (kInput) if they do
  /// not strictly increase.
  explicit Stamps(std::vector<Time> stamps);

  std::size_t size() const { return size_; }
  Time operator[](std::size_t index) const {
    return list_.empty() ? clock_(static_cast<std::int64_t>(index)) : list_[index];
  }
  /// s from this sample to the next one; of the last sample, to where the next one would be.
  double step(std::size_t index) const;
  /// s over which the reading is an average: the step that led to this sample, but a regular period after a gap
  /// (a step above 1.5 periods) and for the first sample. docs/math/noise.md (2)
  double averaging_time(std::size_t index) const;
  /// s; 1/rate of a clock, median step of a list.
  double period() const { return period_; }

 private:
  SampleClock clock_{};
  std::vector<Time> list_;
  std::size_t size_ = 0;
  double period_ = 0.0;
};

}  // namespace vispline

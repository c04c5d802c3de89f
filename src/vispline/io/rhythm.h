/// The rhythm of a stream of stamps: rate, jitter, gaps, order; in constant memory.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "vispline/io/even_sample.h"

namespace vispline {

struct Gap {
  std::int64_t after_ns = 0, length_ns = 0;
};

struct Rhythm {
  std::int64_t count = 0;
  std::int64_t begin_ns = 0, end_ns = 0;  ///< earliest and latest stamp
  std::int64_t out_of_order = 0;          ///< stamps before one that came earlier
  std::int64_t duplicates = 0;            ///< stamps equal to the one before
  std::int64_t median_step_ns = 0;        ///< of the steps forward; 0: there are none
  std::optional<double> jitter;           ///< half the range of nine of ten steps, in median steps
  std::int64_t gaps = 0;                  ///< steps above max(10 median steps, 0.1 s)
  std::int64_t gaps_ns = 0;               ///< their sum
  std::vector<Gap> longest_gaps;          ///< at most five, the longest first

  double duration_s() const { return (static_cast<double>(end_ns) - static_cast<double>(begin_ns)) * 1e-9; }
  /// Stamps per second over the whole length; empty for fewer than two, or no length.
  std::optional<double> rate_hz() const;
};

class RhythmMeter {
 public:
  void add(std::int64_t ns);
  Rhythm rhythm() const;

 private:
  std::vector<Gap> gaps(std::int64_t limit_ns) const;

  Rhythm so_far_;
  std::int64_t last_ns_ = 0;
  EvenSample<std::int64_t> steps_;
  std::vector<Gap> long_steps_;  ///< above 0.1 s; the longest of them
};

}  // namespace vispline

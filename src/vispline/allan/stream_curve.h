/// The overlapping Allan curve of a record of any length in constant memory. docs/math/allan.md, Streaming.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vispline/allan/deviation.h"

namespace vispline {

/// One axis, on the log grid. Factors below 64 use every start, as the exact curve does; a factor in [32, 64) times 2^s
/// uses every 2^s-th, so at least 32 starts an averaging time: the same mean, and degrees of freedom within 1 %.
class StreamCurve {
 public:
  /// `reference` is taken off the readings: any value near their mean.
  explicit StreamCurve(double reference) : reference_(reference) {}

  void push(std::span<const double> readings);
  /// What follows is a segment of its own.
  void end_segment();

  struct Point {
    std::int64_t m;
    SquaredSum sum;  ///< of phase differences at a rate of 1 Hz
  };
  /// Factors that at least one difference was seen for.
  std::vector<Point> points() const;

 private:
  struct Level {
    std::vector<double> phase;          ///< the last 2 * 63 points and what was not yet used
    std::vector<double> pending;        ///< every second point, for the level above once it is sure to get two
    std::int64_t seen = 0;              ///< points of this segment
    std::size_t fresh = 0;              ///< first point of `phase` that no difference ends at yet
    std::vector<std::int64_t> factors;  ///< in points of this level
    std::vector<SquaredSum> sums;
  };
  void push_phase(std::size_t level, std::span<const double> points);
  void use(Level& level);
  Level& level_at(std::size_t index);

  double reference_;
  double phase_ = 0.0;
  bool started_ = false;
  std::vector<Level> levels_;
};

}  // namespace vispline

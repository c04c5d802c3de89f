/// One axis of a plot: from values to pixels.
#pragma once

#include <span>

#include "vispline/report/plot.h"

namespace vispline::report {

/// Whether a value can be drawn on such an axis.
bool drawable(double value, bool log);

/// From the smallest to the largest drawable value; nothing drawable gives lo > hi.
Range extent(std::span<const double> values, bool log);

/// Both ranges in one; one with lo > hi counts for nothing.
Range united(Range a, Range b);

/// A range fit for ticks around an extent: never empty, widened by `margin` of its length at both ends.
Range padded(Range extent, bool log, double margin);

class Axis {
 public:
  /// Range fit for ticks; `length_px` long; y axes grow upwards, against the pixels.
  Axis(Range range, bool log, double length_px, bool upwards);
  /// Precondition: drawable(value). Far outside the box the result is held within 1e5 px.
  double to_px(double value) const;
  const Range& range() const { return range_; }
  bool log() const { return log_; }
  double length_px() const { return length_px_; }

 private:
  double place(double value) const;
  Range range_;
  bool log_;
  double length_px_;
  bool upwards_;
};

/// The two axes of a plot whose box is width x height.
struct Axes {
  Axis x;
  Axis y;
};
Axes make_axes(const Plot& plot, double width_px, double height_px);

}  // namespace vispline::report

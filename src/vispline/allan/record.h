/// The readings of all axes as they stream by: what is held of them, and what is summed.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "vispline/allan/options.h"
#include "vispline/allan/spectrum.h"
#include "vispline/allan/stream_curve.h"

namespace vispline {

/// Range and moments of one axis.
struct AxisMoments {
  double first = 0.0, sum = 0.0, square = 0.0;  ///< sums about the first reading
  double least = INFINITY, most = -INFINITY;

  void add(std::span<const double> readings);
  double mean(std::int64_t n) const;
  double standard_deviation(std::int64_t n) const;
  bool constant() const { return least == most; }
};

/// Holds every reading, or, in bounded memory, the sums of the log grid.
class AllanRecord {
 public:
  AllanRecord(std::size_t axes, const AllanOptions& options);

  /// The next readings of every axis, all of one length.
  void push(std::span<const std::span<const double>> blocks);
  /// Ends the open segment.
  void cut();

  std::size_t axes() const { return axes_.size(); }
  std::int64_t samples() const { return samples_; }
  bool held() const { return held_; }
  /// Of the ended segments.
  const std::vector<std::int64_t>& lengths() const { return lengths_; }
  std::int64_t longest() const;

  const AxisMoments& moments(std::size_t axis) const { return axes_[axis].moments; }
  const SpectrumBuilder& spectrum(std::size_t axis) const { return axes_[axis].spectrum; }
  /// Of a record that is not held.
  const StreamCurve& stream(std::size_t axis) const { return *axes_[axis].stream; }
  /// Phase points of a segment of a held record at a rate of 1 Hz, the mean of the whole record taken off.
  Phase phase(std::size_t axis, std::size_t segment) const;

 private:
  struct Axis {
    AxisMoments moments;
    std::vector<double> readings;  ///< of all segments, while they are held
    SpectrumBuilder spectrum;
    std::optional<StreamCurve> stream;
  };
  void push_axis(Axis& axis, std::span<const double> block) const;
  void let_go();

  std::vector<Axis> axes_;
  AllanMemory memory_;
  std::size_t threads_;
  bool spectra_;
  std::vector<std::int64_t> begins_, lengths_;  ///< of the ended segments
  std::int64_t samples_ = 0, open_ = 0;         ///< `open_`: readings of the segment that is not yet ended
  bool held_ = true;
};

}  // namespace vispline

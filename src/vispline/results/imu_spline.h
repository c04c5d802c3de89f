/// An IMU signal between its samples: a cubic spline on every stretch without a gap. docs/math/evaluate.md (17).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "vispline/core/types.h"
#include "vispline/sensors/recording.h"

namespace vispline {

/// Twice continuously differentiable within a stretch; stretches end where a step exceeds the gap limit. Ends are
/// parabolic (constant second derivative in the first and last interval). Time is in seconds from the first sample.
/// Values are (angular rate rad/s, specific force m/s^2), in the frame of the signal.
class ImuSpline {
 public:
  /// Precondition: `imu` is not empty and `max_gap_s` is positive.
  ImuSpline(const ImuSignal& imu, double max_gap_s);

  /// The interval that holds `seconds`; empty outside the samples and in a gap.
  std::optional<std::size_t> interval(double seconds) const;
  /// Whether the curve is defined on all of [begin_s, end_s].
  bool covers(double begin_s, double end_s) const;

  Vector6d value(std::size_t interval, double seconds) const;
  Vector6d rate(std::size_t interval, double seconds) const;  ///< d value / d time

  double duration_s() const { return seconds_.back(); }

 private:
  void solve_stretch(std::size_t begin, std::size_t end);

  std::vector<double> seconds_;
  std::vector<Vector6d> value_;
  std::vector<Vector6d> curvature_;   ///< second derivative at every sample
  std::vector<std::size_t> stretch_;  ///< number of the stretch of every sample
};

}  // namespace vispline

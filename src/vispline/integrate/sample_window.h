/// The samples that one integration step may look at.
#pragma once

#include <cstddef>
#include <optional>

#include "vispline/core/time.h"
#include "vispline/sensors/recording.h"

namespace vispline {

/// The step from sample `index` to sample `index + 1` of a signal, and the samples around it.
class SampleWindow {
 public:
  /// Preconditions: index + 1 < imu.size(), stamps strictly increasing; the signal outlives the window.
  SampleWindow(const ImuSignal& imu, std::size_t index) : imu_(&imu), index_(index) {}

  const ImuSample& first() const { return imu_->value[index_]; }
  const ImuSample& last() const { return imu_->value[index_ + 1]; }
  /// Length of the step, s.
  double dt() const { return to_seconds(imu_->time[index_ + 1] - imu_->time[index_]); }

  /// The step before this one; none at the first.
  std::optional<SampleWindow> previous() const {
    if (index_ == 0) return std::nullopt;
    return SampleWindow(*imu_, index_ - 1);
  }

  /// The sample at the fraction u of the step, 0 <= u <= 1, on the polynomial through the nearest `points` samples at
  /// their actual stamps. The points are centred on the step, one-sided at the two ends of the signal, and all of the
  /// signal where it is shorter. Exact at u = 0 and u = 1.            docs/math/integrate.md (16)-(17)
  ImuSample interpolate(double u, std::size_t points) const;

 private:
  const ImuSignal* imu_;
  std::size_t index_;
};

}  // namespace vispline

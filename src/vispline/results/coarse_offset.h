/// The offset in time of two IMU signals, to a fraction of a sample, from |angular rate| alone: no rotation between the
/// frames, no start value. docs/math/evaluate.md (18)-(20).
#pragma once

#include <optional>

#include "vispline/results/imu_spline.h"

namespace vispline {

/// A lag is the time in seconds to add to the first signal, each signal counting from its own first sample.
struct CoarseOffset {
  double lag_s = 0.0;
  double step_s = 0.0;              ///< of the grid of lags
  double correlation = 0.0;         ///< Pearson correlation of the two |angular rate| at this lag
  double second_correlation = 0.0;  ///< the highest one outside the peak
  double second_lag_s = 0.0;
  double noise_correlation = 0.0;  ///< what the search over all lags would find in two independent white noises
};

struct LagRange {
  double min_s;
  double max_s;
};

/// Searches all lags in `range` that leave at least half of the shorter signal overlapping, on a uniform grid of about
/// `step_s`, by FFT, cost n log n; gaps are left out of the sums. A signal with more than `max_points` steps is
/// averaged onto a coarser grid. Empty if no such lag exists. `correlation` is 0 if one of the signals does not vary.
std::optional<CoarseOffset> find_coarse_offset(const ImuSpline& first, const ImuSpline& second, double step_s,
                                               LagRange range, double max_points = 1 << 20);

}  // namespace vispline

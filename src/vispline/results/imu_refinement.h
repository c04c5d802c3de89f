/// Offset in time, rotation and gyroscope bias between two IMU signals, to far below a sample.
/// docs/math/evaluate.md (21)-(24).
#pragma once

#include "vispline/core/types.h"
#include "vispline/results/imu_spline.h"
#include "vispline/sensors/recording.h"

namespace vispline {

/// omega_second(s) = R_second_first omega_first(s - lag_s) + bias, each signal counting seconds from its first sample.
struct ImuRefinement {
  double lag_s = 0.0;
  Matrix3d R_second_first = Matrix3d::Identity();
  Vector3d bias = Vector3d::Zero();  ///< rad/s, in the frame of the second signal
  bool rotation_observable = false;  ///< false: rates about one axis only; the smallest rotation that fits was taken
  bool converged = false;            ///< false: lag_s is the start value
};

/// Newton's method from `start_lag_s`, which must be within a fraction of the motion's time scale. The equations are
/// weighted by the second signal, so that noise in either signal does not pull the offset towards or away from the
/// samples. Gaps of `first` are left out. Precondition: the signals overlap at start_lag_s.
ImuRefinement refine_alignment(const ImuSpline& first, const ImuSignal& second, double start_lag_s, double margin_s);

}  // namespace vispline

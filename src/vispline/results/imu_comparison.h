/// Compares two recordings of the same motion by two IMUs, or a synthesised one with a measured one.
/// docs/math/evaluate.md (17)-(27).
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "vispline/core/error.h"
#include "vispline/core/types.h"
#include "vispline/sensors/recording.h"

namespace vispline {

struct ImuCompareOptions {
  /// Largest |time_offset_s| to look for. If it is not given, every offset is tried that keeps half of the shorter
  /// signal, and the stamps of the two signals must overlap as they are.
  std::optional<double> max_offset_s;
};

/// Of the differences (second - aligned first) of one axis of the second signal's frame.
struct AxisComparison {
  double rms = 0.0;                   ///< about zero: the mean is in it
  double mean = 0.0;                  ///< the bias of the second signal relative to the first
  double std = 0.0;                   ///< about the mean
  std::optional<double> correlation;  ///< Pearson, of the two signals; empty if one of them does not vary
};

struct ImuComparison {
  double time_offset_s = 0.0;  ///< to add to the stamps of the first signal to match those of the second
  Matrix3d R_second_first = Matrix3d::Identity();  ///< maps vectors of the first signal's frame to the second's
  Vector3d rotation_vector = Vector3d::Zero();     ///< its logarithm, rad
  double offset_correlation = 0.0;                 ///< of |angular rate| at the offset, before the refinement
  double offset_confidence = 0.0;                  ///< 1 - second highest peak / highest; 1: unique, 0: ambiguous
  bool aligned = false;                            ///< false: too little rotation; offset 0 and the identity were used
  std::array<AxisComparison, 3> gyroscope;         ///< x, y, z; rad/s
  std::array<AxisComparison, 3> accelerometer;     ///< x, y, z; m/s^2
  std::int64_t compared = 0;                       ///< samples of the second signal
  std::int64_t outside = 0;                        ///< samples of the second signal beyond the ends of the first
  std::int64_t in_gaps = 0;                        ///< samples of the second signal in gaps of the first
  ImuSignal first_at_second;                       ///< the first signal, aligned, at the compared stamps of the second
  Diagnostics diagnostics;                         ///< W-EXCITATION, W-AMBIGUOUS, W-CONVERGENCE, W-UNPAIRED
};

/// The first signal is interpolated at the stamps of the second, never across a step longer than
/// max(3 median periods, 0.05 s). Throws Error(kUnfit): "E-TOO-SHORT" for fewer than 10 samples, "E-OVERLAP" if no time
/// is shared.
ImuComparison compare_imu(const ImuSignal& first, const ImuSignal& second, const ImuCompareOptions& options = {});

}  // namespace vispline

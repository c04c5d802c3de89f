/// Pairs the poses of an estimate with those of a reference by time. docs/math/evaluate.md (1)-(3).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "vispline/core/pose.h"
#include "vispline/core/signal.h"

namespace vispline {

enum class AssociationMode {
  kInterpolate,  ///< the reference is interpolated at the stamps of the estimate
  kNearest,      ///< mutually nearest stamps, within a tolerance; 0 demands equal stamps
};

struct AssociationOptions {
  AssociationMode mode = AssociationMode::kInterpolate;
  double tolerance_s = 0.01;        ///< kNearest: largest distance in time of a pair
  std::optional<double> max_gap_s;  ///< kInterpolate: longest step bridged; default max(3 median periods, 0.1 s)
};

struct PosePair {
  Time time;  ///< stamp of the estimate
  Pose T_w_b_estimate;
  Pose T_w_b_reference;
};

/// estimate poses = pairs + estimate_outside + estimate_unmatched.
struct Association {
  std::vector<PosePair> pairs;
  std::int64_t estimate_outside = 0;     ///< before the first or after the last stamp of the reference
  std::int64_t estimate_unmatched = 0;   ///< in a gap of the reference, or without a partner within the tolerance
  std::int64_t reference_unmatched = 0;  ///< kNearest: poses of the reference without a partner; else 0
};

/// Never fails: records that share no time give no pairs.
Association associate(const Signal<Pose>& estimate, const Signal<Pose>& reference, const AssociationOptions& options);

}  // namespace vispline

/// Absolute and relative error of an estimated trajectory. docs/math/evaluate.md (9)-(14).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "vispline/core/error.h"
#include "vispline/results/alignment.h"
#include "vispline/results/association.h"

namespace vispline {

/// Of non-negative errors; std is about their mean, divided by n.
struct ErrorStatistics {
  double rmse = 0.0, mean = 0.0, median = 0.0, max = 0.0, std = 0.0;
};

/// All zero for no errors.
ErrorStatistics error_statistics(std::vector<double> errors);

enum class DeltaUnit { kSeconds, kMetres };

/// Distance between the two poses of a relative error: in time, or along the path of the reference.
struct RelativeDelta {
  double value = 1.0;
  DeltaUnit unit = DeltaUnit::kSeconds;
};

struct RelativeError {
  RelativeDelta delta;
  std::int64_t pairs = 0;
  std::optional<double> translation_rmse_m;  ///< empty without pairs
  std::optional<double> rotation_rmse_deg;   ///< empty without pairs
};

struct TrajectoryCompareOptions {
  AlignmentMode alignment = AlignmentMode::kSe3;
  AssociationOptions association;
  std::vector<RelativeDelta> deltas = {
      {1.0, DeltaUnit::kSeconds}, {5.0, DeltaUnit::kSeconds}, {1.0, DeltaUnit::kMetres}, {5.0, DeltaUnit::kMetres}};
  double delta_tolerance = 0.1;  ///< a pair may miss its delta by this share of it
};

struct TrajectoryComparison {
  AlignmentMode alignment_mode = AlignmentMode::kNone;
  Alignment alignment;
  Association association;  ///< the pairs, the estimate as it was before alignment, and the counts
  double duration_s = 0.0;
  double path_length_m = 0.0;      ///< of the reference at the compared stamps
  ErrorStatistics position_m;      ///< absolute trajectory error
  double rotation_rmse_deg = 0.0;  ///< attitude error after alignment
  double rotation_max_deg = 0.0;
  std::vector<RelativeError> relative;  ///< one per option delta
  Diagnostics diagnostics;              ///< W-UNPAIRED
};

/// Compares T_w_b of the estimate with T_w_b of the reference; both must describe the same body frame b.
/// Throws Error(kUnfit): "E-OVERLAP" without a pair, "E-ALIGN" where the alignment is not unique.
TrajectoryComparison compare_trajectories(const Signal<Pose>& estimate, const Signal<Pose>& reference,
                                          const TrajectoryCompareOptions& options = {});

}  // namespace vispline

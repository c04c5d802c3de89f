/// Error of integrated poses against the curve they should follow, and its order in the sampling step.
/// docs/math/evaluate.md (15)-(16).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "vispline/core/pose.h"
#include "vispline/core/signal.h"
#include "vispline/trajectory/trajectory.h"

namespace vispline {

/// No alignment: dead reckoning starts at the truth.
struct DeadReckoningError {
  double final_error_m = 0.0;  ///< at the last compared stamp
  double max_error_m = 0.0;
  double rmse_m = 0.0;
  double attitude_error_deg = 0.0;  ///< largest angle between estimate and truth
  std::int64_t samples = 0;         ///< compared
  std::int64_t outside = 0;         ///< stamps outside the span of the truth: not compared
};

/// Throws Error(kUnfit, "E-OVERLAP") if no stamp is inside the span of the truth.
DeadReckoningError dead_reckoning_error(const Signal<Pose>& T_w_b, const Trajectory& truth);

/// One row of the integration table.
struct IntegrationRow {
  std::string method;
  double rate_hz = 0.0;
  DeadReckoningError error;
  std::optional<double> order;  ///< observed from the next lower rate to this one; empty at the lowest
};

/// Fills `order` of every row from the maximum errors of the same method at this and the next lower rate:
/// log(error_low / error) / log(rate / rate_low). The rows keep their places.   docs/math/evaluate.md (16)
void fill_observed_orders(std::vector<IntegrationRow>& rows);

}  // namespace vispline

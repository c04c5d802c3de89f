/// A curve through measured poses, by the estimator's own rows. docs/math/estimate.md, Start values.
#pragma once

#include <memory>
#include <vector>

#include "vispline/core/signal.h"
#include "vispline/estimate/curve.h"

namespace vispline {

struct PoseCurve {
  std::shared_ptr<const Curve> curve{};
  std::vector<TimeSpan> gaps{};  ///< between poses, longer than three of their usual steps
  double position_rms_m = 0.0;
  double rotation_rms_rad = 0.0;

  bool in_gap(Time time) const;
};

/// Knots as far apart as the poses usually are, but no closer than `least_spacing`; outliers are weighed down. The
/// sigmas set what counts as an outlier. Throws Error(kUnfit, E-TOO-SHORT) for fewer than four poses.
PoseCurve fit_pose_curve(const Signal<Pose>& T_w_s, Duration least_spacing, double position_sigma_m,
                         double rotation_sigma_rad);

}  // namespace vispline

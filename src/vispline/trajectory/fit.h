/// A trajectory from measured poses: noisy, irregular, with gaps. docs/math/fit.md.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "vispline/core/pose.h"
#include "vispline/core/signal.h"
#include "vispline/trajectory/spectrum.h"
#include "vispline/trajectory/trajectory.h"

namespace vispline {

enum class SplineKind { kJoint, kSplit };  ///< SE(3), the paper's, or R^3 x SO(3)

struct TrajectoryFitOptions {
  SplineKind kind = SplineKind::kJoint;
  int order = 4;                    ///< 4, 5 or 6
  std::optional<double> spacing_s;  ///< knot spacing; chosen from the spectrum of the poses if absent
  double quality = 0.99999;         ///< share of the motion's energy that the knots have to carry, if chosen
  std::function<void()> poll{};     ///< called every few milliseconds of work; may throw to stop the fit
};

/// Size of the residuals of one kind of motion, per axis.
struct FitResidual {
  double rms = 0.0;
  double max = 0.0;
};

struct TrajectoryFit {
  Trajectory trajectory;
  double spacing_s = 0.0;
  std::size_t knots = 0;
  std::optional<PoseSpectrum> spectrum;  ///< empty if the data are too short for one
  FitResidual position_m;
  FitResidual rotation_rad;
  std::vector<TimeSpan> gaps;  ///< between poses too far apart to know the motion: the curve there is only a guess
  std::size_t outliers = 0;    ///< poses more than ten usual residuals from the curve: left out
  int iterations = 0;
  bool converged = false;

  bool in_gap(Time time) const;
};

/// Throws Error E-FIT-SHORT if no knot spacing is given and none can be chosen, E-ARGUMENT for a wrong order.
TrajectoryFit fit_trajectory(const Signal<Pose>& poses, const TrajectoryFitOptions& options = {});

}  // namespace vispline

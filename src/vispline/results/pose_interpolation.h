/// A pose between the stamps of a pose signal. docs/math/evaluate.md (2)-(3).
#pragma once

#include <optional>

#include "vispline/core/pose.h"
#include "vispline/core/signal.h"

namespace vispline {

/// The pose at `time`, on SE(3) and independent of the choice of the world frame: a cubic in the tangent space through
/// the two poses before and the two after where the three steps differ by at most a factor of two, else the geodesic
/// between the two neighbours. At a stamp, the pose of that stamp. Empty outside the span and inside a step longer than
/// `max_gap_s`.
std::optional<Pose> interpolate_pose(const Signal<Pose>& poses, Time time, double max_gap_s);

}  // namespace vispline

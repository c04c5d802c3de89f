/// Dead reckoning: an IMU signal integrated from a known start. docs/math/integrate.md.
#pragma once

#include <string_view>

#include "vispline/core/signal.h"
#include "vispline/integrate/nav_state.h"
#include "vispline/sensors/recording.h"

namespace vispline {

/// One state per sample, the first of them `start`, at the samples' own stamps (irregular ones are welcome). An empty
/// signal gives an empty one. g_w is gravitational acceleration and points down: (0, 0, -9.81) m/s^2.
/// `rule` is a name of rule_names(); throws Error for any other and for stamps that do not increase.
Signal<NavState> dead_reckon(const ImuSignal& imu, const NavState& start, std::string_view rule, const Vector3d& g_w);

/// The poses of integrated states, T_w_b, quaternions normalised.
Signal<Pose> poses(const Signal<NavState>& states);

}  // namespace vispline

/// Poses of a rolling-shutter camera before a known target, good enough to start from: an image that is read while the
/// camera turns is no picture of one instant. docs/math/estimate.md, Start values.
#pragma once

#include <optional>

#include "vispline/core/pose.h"
#include "vispline/estimate/assemble.h"
#include "vispline/sensors/recording.h"

namespace vispline {

struct RollingPoses {
  Signal<Pose> T_t_c{};  ///< at the middle lines, on the camera's clock
  double correlation = 0.0;
  double rms_px = 0.0;
};

/// How the camera turns is taken from its tracks and laid on the gyroscope, which then says how it stood at every line:
/// what is left for an image is its place, linear in the rays. `T_t_c`: poses of the images as if each were one
/// instant; they say how the world of the gyroscope lies. Empty if the rates agree at no offset.
std::optional<RollingPoses> rolling_poses(const Camera& camera, const FeatureSignal& features,
                                          const TargetPoints& target, const Signal<Pose>& T_t_c, const ImuSignal& imu);

}  // namespace vispline

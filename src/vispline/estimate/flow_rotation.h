/// How a camera turns, from tracks alone: a virtual gyroscope in frame c. docs/math/estimate.md, Start values.
#pragma once

#include "vispline/sensors/camera.h"
#include "vispline/sensors/recording.h"

namespace vispline {

/// One angular rate for every two successive frames that share features, stamped in the middle of their middle lines on
/// the camera's clock. What translation does to near points counts as outliers. The accelerometer's readings are zero.
ImuSignal turning_rate(const Camera& camera, const FeatureSignal& features);

}  // namespace vispline

/// What the instruments of a rig wrote down.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "vispline/core/signal.h"
#include "vispline/core/types.h"

namespace vispline {

/// One reading of an IMU, in its own frame i.
struct ImuSample {
  Vector3d gyro = Vector3d::Zero();   ///< angular rate, rad/s
  Vector3d accel = Vector3d::Zero();  ///< specific force, m/s^2; (0, 0, +9.81) at rest with z up
};

using ImuSignal = Signal<ImuSample>;

/// One landmark in one image. Ids are stable over frames and cameras; of a known target, the id is the index of the
/// point.
struct Feature {
  std::uint64_t id = 0;
  Vector2d px = Vector2d::Zero();
};

/// Frames by their stamps, which are those of the camera's own clock.
using FeatureSignal = Signal<std::vector<Feature>>;

struct Recording {
  std::map<std::string, ImuSignal> imus;          ///< by the name of the IMU
  std::map<std::string, FeatureSignal> features;  ///< by the name of the camera
};

}  // namespace vispline

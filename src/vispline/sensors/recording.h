/// What the instruments of a rig wrote down.
#pragma once

#include <map>
#include <string>

#include "vispline/core/signal.h"
#include "vispline/core/types.h"

namespace vispline {

/// One reading of an IMU, in its own frame i.
struct ImuSample {
  Vector3d gyro = Vector3d::Zero();   ///< angular rate, rad/s
  Vector3d accel = Vector3d::Zero();  ///< specific force, m/s^2; (0, 0, +9.81) at rest with z up
};

using ImuSignal = Signal<ImuSample>;

struct Recording {
  std::map<std::string, ImuSignal> imus;  ///< by the name of the IMU
};

}  // namespace vispline

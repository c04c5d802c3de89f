/// An inertial measurement unit: a gyroscope and an accelerometer that are sampled together.
#pragma once

#include <string>

#include "vispline/core/noise.h"
#include "vispline/sensors/accelerometer.h"
#include "vispline/sensors/gyroscope.h"

namespace vispline {

/// Exact, at the origin of the body and without noise by default. Each triad has its own pose and time offset.
struct Imu {
  std::string name = "imu0";  ///< unique in a rig; also names the IMU's random streams
  double rate_hz = 200.0;
  Gyroscope::Params<double> gyroscope{};
  Accelerometer::Params<double> accelerometer{};
  ImuNoise noise{};
};

/// Throws Error(kUsage, E-CONFIG) with the name of the IMU and the field unless the name is not empty, the rate is
/// positive, all parameters are finite and all noise figures are finite and not negative.
void require_valid(const Imu& imu);

}  // namespace vispline

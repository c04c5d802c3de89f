/// IMU.* of an ORB-SLAM3 settings file: continuous-time densities, which the program multiplies or divides by
/// sqrt(IMU.Frequency) itself.
#pragma once

#include "vispline/calibration/noise_entry.h"

namespace vispline::orbslam3_noise {

inline constexpr const char* kName = "orbslam3";

NamedText write(const ImuNoiseEntry& entry);

}  // namespace vispline::orbslam3_noise

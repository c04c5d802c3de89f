/// IMU.* of an ORB-SLAM3 settings file: continuous-time densities, which the program multiplies or divides by
/// sqrt(IMU.Frequency) itself.
#pragma once

#include "vispline/calibration/noise_reading.h"

namespace vispline::orbslam3_noise {

inline constexpr const char* kName = "orbslam3";

NamedText write(const ImuNoiseEntry& entry);

/// By content.
bool recognizes(const YamlFile& file);
/// The other keys of the settings are left alone.
NoiseReading read(const YamlFile& file, const NoiseReadOptions& options);

}  // namespace vispline::orbslam3_noise

/// kalibr_imu_chain.yaml of OpenVINS: Kalibr's keys under imu0, in the head that OpenCV asks for.
#pragma once

#include "vispline/calibration/noise_reading.h"

namespace vispline::openvins_noise {

inline constexpr const char* kName = "openvins";

/// An ideal IMU (no scale or misalignment) at the origin of the body.
NamedText write(const ImuNoiseEntry& entry);

/// By content.
bool recognizes(const YamlFile& file);

NoiseReading read(const YamlFile& file, const NoiseReadOptions& options);

}  // namespace vispline::openvins_noise

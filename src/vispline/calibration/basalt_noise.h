/// The noise keys of a Basalt calibration (JSON, inside "value0"): continuous time in spite of the word std; the
/// program multiplies the two noise_std by sqrt(imu_update_rate) itself. JSON has no comments: what is to be said is in
/// `notes`.
#pragma once

#include "vispline/calibration/noise_reading.h"

namespace vispline::basalt_noise {

inline constexpr const char* kName = "basalt";

NamedText write(const ImuNoiseEntry& entry);

/// By content.
bool recognizes(const YamlFile& file);
/// Axes that differ are read as their largest, with W-CONFIG.
NoiseReading read(const YamlFile& file, const NoiseReadOptions& options);

}  // namespace vispline::basalt_noise

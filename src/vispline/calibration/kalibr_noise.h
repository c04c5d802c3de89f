/// imu.yaml of Kalibr: continuous-time figures, every number a YAML 1.1 float.
#pragma once

#include "vispline/calibration/noise_reading.h"

namespace vispline::kalibr_noise {

inline constexpr const char* kName = "kalibr";

NamedText write(const ImuNoiseEntry& entry);

/// The four figures in Kalibr's keys, each line behind `indent`; also the form of OpenVINS.
std::string figure_lines(const std::string& indent, const ImuNoiseEntry& entry, std::vector<std::string>& notes);

/// By content.
bool recognizes(const YamlFile& file);
/// imu.yaml, the imu0 of Kalibr's results, or sensor.yaml of an EuRoC folder.
NoiseReading read(const YamlFile& file, const NoiseReadOptions& options);

/// What `write` writes with figure_lines, from any map that holds it; the rate from "update_rate" or "rate_hz".
ImuNoiseEntry read_figures(ConfigMap& map);

}  // namespace vispline::kalibr_noise

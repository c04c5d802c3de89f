/// imu.yaml of Kalibr: continuous-time figures, every number a YAML 1.1 float.
#pragma once

#include "vispline/calibration/noise_entry.h"

namespace vispline::kalibr_noise {

inline constexpr const char* kName = "kalibr";

NamedText write(const ImuNoiseEntry& entry);

/// The four figures in Kalibr's keys, each line behind `indent`; also the form of OpenVINS.
std::string figure_lines(const std::string& indent, const ImuNoiseEntry& entry, std::vector<std::string>& notes);

}  // namespace vispline::kalibr_noise

/// The noise of an IMU in the parameter files of other tools. docs/calibration-files.md.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vispline/calibration/noise_entry.h"

namespace vispline {

/// Per-axis figures for the dialect that has room for them (imu_utils).
struct ImuUtilsTables {
  ImuUtilsTriad gyro{};   ///< rad/s
  ImuUtilsTriad accel{};  ///< m/s^2
};

/// "kalibr", "openvins", "vins-fusion", "orbslam3", "basalt", "imu_utils".
std::vector<std::string> noise_dialects();

/// The file of `dialect`. A walk without a value is written as its upper bound, and one without a bound is left out;
/// the text (or, where a format has no comments, `notes`) says so. `tables` serve imu_utils only; without them its
/// figures follow from N and K: n = N sqrt(rate), w = sqrt(2 N K / sqrt(3)). Throws E-CONFIG (exit 2) for an unknown
/// dialect, for a white noise or a rate that is not positive and finite, and for a walk that is not.
NamedText noise_file(std::string_view dialect, const ImuNoiseEntry& entry,
                     const std::optional<ImuUtilsTables>& tables = std::nullopt);

}  // namespace vispline

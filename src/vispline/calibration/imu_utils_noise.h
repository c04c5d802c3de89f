/// NAME_imu_param.yaml of imu_utils. Its gyr_n and acc_n are standard deviations of one sample, N sqrt(rate), and its
/// gyr_w and acc_w the minimum of the fitted Allan deviation; see imu_utils_explanation.h.
#pragma once

#include "vispline/calibration/noise_files.h"

namespace vispline::imu_utils_noise {

inline constexpr const char* kName = "imu_utils";

/// All axes alike, from N and K: n = N sqrt(rate), w = sqrt(2 N K / sqrt(3)).
ImuUtilsTables tables_from(const ImuNoiseEntry& entry);

/// A walk that the tables do not hold is left out, with a comment; where they are not measured but follow from an upper
/// bound of K, a comment says that.
NamedText write(const ImuNoiseEntry& entry, const std::optional<ImuUtilsTables>& tables);

}  // namespace vispline::imu_utils_noise

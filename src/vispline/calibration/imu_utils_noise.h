/// NAME_imu_param.yaml of imu_utils. Its gyr_n and acc_n are standard deviations of one sample, N sqrt(rate), and its
/// gyr_w and acc_w the minimum of the fitted Allan deviation; see imu_utils_explanation.h.
#pragma once

#include "vispline/calibration/noise_files.h"
#include "vispline/calibration/noise_reading.h"

namespace vispline::imu_utils_noise {

inline constexpr const char* kName = "imu_utils";

/// imu_utils searches the minimum from 1000 downwards: deg/h (with 57.3 for 180/pi) and m/s^2. In SI:
inline constexpr double kGyroSaturation = 1000.0 / (57.3 * 3600.0);  ///< rad/s
inline constexpr double kAccelSaturation = 1000.0;                   ///< m/s^2
/// `w` is where the search began: the minimum is at least that.
bool is_saturated(double w, double saturation);

/// All axes alike, from N and K: n = N sqrt(rate), w = sqrt(2 N K / sqrt(3)).
ImuUtilsTables tables_from(const ImuNoiseEntry& entry);

/// A walk that the tables do not hold is left out, with a comment; where they are not measured but follow from an upper
/// bound of K, a comment says that.
NamedText write(const ImuNoiseEntry& entry, const std::optional<ImuUtilsTables>& tables);

/// By content.
bool recognizes(const YamlFile& file);
/// Needs options.rate_hz. N is that of the average axis, by the likely meaning of n; the minimum of the curve gives an
/// upper bound of K, with W-CONFIG. `tables` hold what the file says; .nan in the average is E-CONFIG.
NoiseReading read(const YamlFile& file, const NoiseReadOptions& options);

/// What the file says, .nan where it says so.
ImuUtilsTables read_tables(const YamlFile& file, Diagnostics& diagnostics);
/// "name" of the file.
std::string read_name(const YamlFile& file, Diagnostics& diagnostics);

}  // namespace vispline::imu_utils_noise

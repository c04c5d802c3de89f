/// What a reader of a noise file hands out, and what the readers share.
#pragma once

#include <optional>
#include <string>

#include "vispline/calibration/config_map.h"
#include "vispline/calibration/noise_entry.h"
#include "vispline/calibration/noise_files.h"

namespace vispline {

struct NoiseReadOptions {
  std::optional<double> rate_hz{};  ///< of the IMU, for files with figures of one sample and without a rate
};

struct NoiseReading {
  std::string dialect{};  ///< one of noise_dialects()
  ImuNoiseEntry entry{};
  std::optional<ImuUtilsTables> tables{};  ///< of imu_utils
  Diagnostics diagnostics{};
};

namespace dialect {

inline constexpr const char* kGyroWhiteUnit = "rad/s/sqrt(Hz)";
inline constexpr const char* kAccelWhiteUnit = "m/s^2/sqrt(Hz)";
inline constexpr const char* kGyroWalkUnit = "rad/s^2/sqrt(Hz)";
inline constexpr const char* kAccelWalkUnit = "m/s^3/sqrt(Hz)";

/// `value`, with W-CONFIG outside 1e-7 to 1.
double plausible(ConfigMap& map, std::string_view key, double value, std::string_view unit);
/// The walk under `key` times `factor`; empty with W-CONFIG if it is missing.
std::optional<double> plausible_walk(ConfigMap& map, std::string_view key, std::string_view unit, double factor = 1.0);
/// options.rate_hz; E-CONFIG at `key` without one.
double required_rate(const ConfigMap& map, std::string_view key, const NoiseReadOptions& options);

}  // namespace dialect
}  // namespace vispline

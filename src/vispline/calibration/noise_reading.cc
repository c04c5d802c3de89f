#include "vispline/calibration/noise_reading.h"

#include <cmath>

#include "vispline/calibration/dialect_text.h"
#include "vispline/calibration/yaml_error.h"

namespace vispline::dialect {

double plausible(ConfigMap& map, std::string_view key, double value, std::string_view unit) {
  if (value < 1e-7 || value > 1.0) {
    map.warn(key, "says " + brief(value) + " " + std::string(unit) + ": not plausible, 1e-07 to 1 is");
  }
  return value;
}

std::optional<double> plausible_walk(ConfigMap& map, std::string_view key, std::string_view unit, double factor) {
  const auto value = map.positive_or_warn(key, unit);
  return value ? std::optional(plausible(map, key, *value * factor, unit)) : std::nullopt;
}

double required_rate(const ConfigMap& map, std::string_view key, const NoiseReadOptions& options) {
  if (!options.rate_hz) {
    fail_config("the figures of this file are those of one sample, and it does not hold the sample rate",
                map.where(key), "give the rate of the IMU: --rate HZ");
  }
  if (!std::isfinite(*options.rate_hz) || *options.rate_hz <= 0.0) {
    fail_config("the rate is " + brief(*options.rate_hz) + ", expected a positive number in Hz", "");
  }
  return *options.rate_hz;
}

}  // namespace vispline::dialect

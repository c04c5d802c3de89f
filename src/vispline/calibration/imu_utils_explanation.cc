#include "vispline/calibration/imu_utils_explanation.h"

#include <cmath>
#include <numbers>

#include "vispline/calibration/dialect_text.h"
#include "vispline/calibration/imu_utils_noise.h"
#include "vispline/calibration/yaml_error.h"

namespace vispline {
namespace {

constexpr double kShortestTauStar = 1.0;  // s

void require_positive(double value, const char* what) {
  if (std::isfinite(value) && value > 0.0) return;
  fail_config(std::string(what) + " is " + dialect::brief(value) + ", expected a positive number", "");
}

TauStarPlace place_of(double tau_star_s, std::optional<double> record_s) {
  if (!record_s) return TauStarPlace::kUnknown;
  if (tau_star_s > *record_s / 2.0) return TauStarPlace::kOutside;
  return tau_star_s > *record_s / 10.0 ? TauStarPlace::kVague : TauStarPlace::kInside;
}

ImuUtilsReading reading(double white, std::optional<double> w, std::optional<double> record_s) {
  ImuUtilsReading result{.white = white};
  if (!w) return result;
  result.walk = std::numbers::sqrt3 * *w * *w / (2.0 * white);
  result.tau_star_s = std::numbers::sqrt3 * white / *result.walk;
  result.place = place_of(*result.tau_star_s, record_s);
  return result;
}

ImuUtilsAxisMeaning meaning(const char* axis, const ImuUtilsFigure& figure, double saturation, double rate_hz,
                            std::optional<double> record_s) {
  ImuUtilsAxisMeaning result{.axis = axis, .figure = figure};
  result.is_saturated = figure.w && imu_utils_noise::is_saturated(*figure.w, saturation);
  if (!std::isfinite(figure.n) || figure.n <= 0.0) return result;
  const bool has_minimum = figure.w && std::isfinite(*figure.w) && *figure.w > 0.0 && !result.is_saturated;
  const std::optional<double> w = has_minimum ? figure.w : std::nullopt;
  result.as_sigma = reading(figure.n / std::sqrt(rate_hz), w, record_s);
  result.as_density = reading(figure.n, w, record_s);
  return result;
}

ImuUtilsTriadMeaning triad(const ImuUtilsTriad& figures, const char* unit, const char* walk_unit, double saturation,
                           double rate_hz, std::optional<double> record_s) {
  return {.unit = unit,
          .walk_unit = walk_unit,
          .axes = {meaning("avg", figures.average, saturation, rate_hz, record_s),
                   meaning("x", figures.axis[0], saturation, rate_hz, record_s),
                   meaning("y", figures.axis[1], saturation, rate_hz, record_s),
                   meaning("z", figures.axis[2], saturation, rate_hz, record_s)}};
}

bool density_is_likely(const ImuUtilsExplanation& explanation) {
  int known = 0;
  for (const ImuUtilsTriadMeaning* sensor : {&explanation.gyro, &explanation.accel}) {
    for (const ImuUtilsAxisMeaning& axis : sensor->axes) {
      if (!axis.as_sigma || !axis.as_sigma->tau_star_s) continue;
      ++known;
      if (*axis.as_sigma->tau_star_s >= kShortestTauStar) return false;
    }
  }
  return known > 0;
}

}  // namespace

ImuUtilsExplanation explain_imu_utils(const ImuUtilsTables& tables, double rate_hz, std::optional<double> record_s) {
  require_positive(rate_hz, "the rate in Hz");
  if (record_s) require_positive(*record_s, "the length of the record in s");
  ImuUtilsExplanation result{.rate_hz = rate_hz, .record_s = record_s};
  result.gyro = triad(tables.gyro, "rad/s", "rad/s^2/sqrt(Hz)", imu_utils_noise::kGyroSaturation, rate_hz, record_s);
  result.accel = triad(tables.accel, "m/s^2", "m/s^3/sqrt(Hz)", imu_utils_noise::kAccelSaturation, rate_hz, record_s);
  result.density_is_likely = density_is_likely(result);
  return result;
}

ImuUtilsExplanation explain_imu_utils_file(const std::string& path, double rate_hz, std::optional<double> record_s) {
  const YamlFile file = read_yaml(path);
  if (!imu_utils_noise::recognizes(file)) {
    fail_config("not a result of imu_utils: keys Gyr and Acc are missing", path);
  }
  Diagnostics diagnostics;
  const ImuUtilsTables tables = imu_utils_noise::read_tables(file, diagnostics);
  ImuUtilsExplanation result = explain_imu_utils(tables, rate_hz, record_s);
  result.name = imu_utils_noise::read_name(file, diagnostics);
  result.diagnostics = diagnostics;
  return result;
}

}  // namespace vispline

#include <array>
#include <charconv>
#include <cmath>

#include "vispline/calibration/dialect_text.h"
#include "vispline/calibration/imu_utils_explanation.h"

namespace vispline {
namespace {

constexpr std::size_t kWidth = 13;

std::string cell(const std::string& text) { return std::string(kWidth - std::min(kWidth, text.size()), ' ') + text; }

std::string number(std::optional<double> value) {
  if (!value) return "-";
  if (!std::isfinite(*value)) return "nan";
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, *value, std::chars_format::general, 4).ptr};
}

const char* words(TauStarPlace place) {
  switch (place) {
    case TauStarPlace::kInside:
      return "tau* is inside the record";
    case TauStarPlace::kVague:
      return "tau* is near the end of the record: K is vague";
    case TauStarPlace::kOutside:
      return "tau* is outside the record: K means nothing";
    case TauStarPlace::kUnknown:
      return "";
  }
  return "";
}

std::string remark(const ImuUtilsAxisMeaning& axis, const std::optional<ImuUtilsReading>& reading) {
  if (!reading) return "no noise figure: the fit failed";
  if (axis.is_saturated) return "w is where the search began (1000): the minimum is above it";
  if (!reading->walk) return "no minimum";
  return words(reading->place);
}

std::string row(const ImuUtilsAxisMeaning& axis, bool n_is_density) {
  const auto& reading = n_is_density ? axis.as_density : axis.as_sigma;
  std::string text = "  " + axis.axis + std::string(5 - axis.axis.size(), ' ');
  text += cell(number(axis.figure.n)) + cell(number(axis.figure.w));
  text += cell(number(reading ? std::optional(reading->white) : std::nullopt));
  text += cell(number(reading ? reading->walk : std::nullopt));
  text += cell(number(reading ? reading->tau_star_s : std::nullopt));
  const std::string end = remark(axis, reading);
  return text + (end.empty() ? "" : "  " + end) + "\n";
}

std::string table(const char* title, const char* key, const ImuUtilsTriadMeaning& sensor, bool n_is_density) {
  const std::string k = key;
  std::string text = std::string(title) + "; n, w in " + sensor.unit + ", N in " + sensor.unit + "/sqrt(Hz), K in " +
                     sensor.walk_unit + ", tau* in s\n";
  text += "  axis " + cell(k + "_n") + cell(k + "_w") + cell("N") + cell("K at most") + cell("tau*") + "\n";
  for (const ImuUtilsAxisMeaning& axis : sensor.axes) text += row(axis, n_is_density);
  return text;
}

}  // namespace

std::string to_text(const ImuUtilsExplanation& explanation) {
  const bool density = explanation.density_is_likely;
  const std::string rate = dialect::brief(explanation.rate_hz) + " Hz";
  std::string text = "imu_utils result " + vispline::quoted(explanation.name) + ", sampled at " + rate + "\n\n";
  if (density) {
    text +=
        "gyr_n and acc_n: read as the white noise density N itself, as first versions of the tool printed it. Read as\n"
        "standard deviations of one sample, as later versions print, they would put the minimum of every curve below\n"
        "1 s, where no IMU has it.\n";
  } else {
    text += "gyr_n and acc_n: read as standard deviations of one sample, N sqrt(rate). N = n / sqrt(" + rate +
            ") is the\n"
            "density that Kalibr and others want. If the file is of a first version of the tool, n is N already.\n";
  }
  text +=
      "gyr_w and acc_w: the minimum of the fitted Allan deviation. Neither the random walk K nor the bias "
      "instability:\n"
      "do not paste them as gyroscope_random_walk or accelerometer_random_walk. With white noise and random walk "
      "only,\n"
      "w = sqrt(2 N K / sqrt 3), so K = sqrt(3) w^2 / (2 N), reached at tau* = sqrt(3) N / K. With flicker noise as "
      "well\n"
      "K is smaller than that, and the bias instability is at most w / 0.664.\n";
  if (explanation.record_s) {
    text += "The record is " + dialect::brief(*explanation.record_s) +
            " s long; K can be trusted if tau* is below a tenth of that.\n";
  } else {
    text += "K can be trusted only if the record is at least ten times as long as tau*.\n";
  }
  text += "\n" + table("Gyroscope", "gyr", explanation.gyro, density);
  return text + "\n" + table("Accelerometer", "acc", explanation.accel, density);
}

}  // namespace vispline

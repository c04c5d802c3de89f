#include "vispline/calibration/vins_fusion_noise.h"

#include <cmath>

#include "vispline/calibration/config_map.h"
#include "vispline/calibration/dialect_text.h"

namespace vispline::vins_fusion_noise {
using namespace dialect;
namespace {

/// The density stands in the comment, because the file itself does not hold the rate.
std::string white_line(const char* key, double density, double rate_hz, const std::string& unit) {
  return value_line(
      "", key, yaml_float(density * std::sqrt(rate_hz)),
      unit + ", one sample at " + brief(rate_hz) + " Hz; density " + brief(density) + " " + unit + "/sqrt(Hz)");
}

std::string drift_line(const char* key, const WalkEntry& walk, double rate_hz, const std::string& unit,
                       std::vector<std::string>& notes) {
  std::string comment = unit + ", drift of the bias in one sample at " + brief(rate_hz) + " Hz";
  if (const auto k = written_walk(walk)) comment += "; density " + brief(*k) + " " + unit + "/sqrt(Hz)";
  return walk_line({"", key, comment, std::sqrt(rate_hz)}, walk, notes);
}

}  // namespace

NamedText write(const ImuNoiseEntry& entry) {
  NamedText file{.file_name = "vins_fusion_imu.yaml"};
  file.text =
      "# For the configuration of VINS-Fusion or VINS-Mono: replace the lines of the same keys.\n"
      "# Standard deviations of one sample, which is how these programs use them. They are measured values. The ones\n"
      "# that the programs ship with are inflated to cover what their model leaves out; if the estimate is\n"
      "# overconfident, multiply acc_n and gyr_n by 2 to 10.\n";
  file.text += white_line("acc_n", entry.accel_white, entry.rate_hz, "m/s^2");
  file.text += white_line("gyr_n", entry.gyro_white, entry.rate_hz, "rad/s");
  file.text += drift_line("acc_w", entry.accel_walk, entry.rate_hz, "m/s^3", file.notes);
  file.text += drift_line("gyr_w", entry.gyro_walk, entry.rate_hz, "rad/s^2", file.notes);
  file.text += value_line("", "g_norm", yaml_float(9.81), "m/s^2, gravity; set that of your place");
  file.notes.push_back("the values are standard deviations of one sample at " + brief(entry.rate_hz) +
                       " Hz, as VINS uses them, not densities");
  file.next_command = "rosrun vins vins_node CONFIG.yaml";
  return file;
}

bool recognizes(const YamlFile& file) { return file.root.find("acc_n") && file.root.find("gyr_n"); }

NoiseReading read(const YamlFile& file, const NoiseReadOptions& options) {
  NoiseReading reading{.dialect = kName};
  ConfigMap root(file, file.root, "", reading.diagnostics);
  root.accept_all({"acc_n", "gyr_n", "acc_w", "gyr_w", "g_norm"});
  ImuNoiseEntry& entry = reading.entry;
  entry.rate_hz = required_rate(root, "acc_n", options);
  const double root_rate = std::sqrt(entry.rate_hz);
  entry.accel_white = plausible(root, "acc_n", root.positive("acc_n", "m/s^2") / root_rate, kAccelWhiteUnit);
  entry.gyro_white = plausible(root, "gyr_n", root.positive("gyr_n", "rad/s") / root_rate, kGyroWhiteUnit);
  entry.accel_walk.value = plausible_walk(root, "acc_w", kAccelWalkUnit, 1.0 / root_rate);
  entry.gyro_walk.value = plausible_walk(root, "gyr_w", kGyroWalkUnit, 1.0 / root_rate);
  entry.topic = root.text_or("imu_topic", entry.topic);
  return reading;
}

}  // namespace vispline::vins_fusion_noise

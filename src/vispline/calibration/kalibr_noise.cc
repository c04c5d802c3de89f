#include "vispline/calibration/kalibr_noise.h"

#include "vispline/calibration/config_map.h"
#include "vispline/calibration/dialect_text.h"

namespace vispline::kalibr_noise {
using namespace dialect;
namespace {
constexpr const char* kAccelWhite = "accelerometer_noise_density";
constexpr const char* kAccelWalk = "accelerometer_random_walk";
constexpr const char* kGyroWhite = "gyroscope_noise_density";
constexpr const char* kGyroWalk = "gyroscope_random_walk";
}  // namespace

std::string figure_lines(const std::string& indent, const ImuNoiseEntry& entry, std::vector<std::string>& notes) {
  return value_line(indent, kAccelWhite, yaml_float(entry.accel_white), "m/s^2/sqrt(Hz), white") +
         walk_line({indent, kAccelWalk, "m/s^3/sqrt(Hz), bias walk"}, entry.accel_walk, notes) +
         value_line(indent, kGyroWhite, yaml_float(entry.gyro_white), "rad/s/sqrt(Hz), white") +
         walk_line({indent, kGyroWalk, "rad/s^2/sqrt(Hz), bias walk"}, entry.gyro_walk, notes);
}

NamedText write(const ImuNoiseEntry& entry) {
  NamedText file{.file_name = "imu.yaml", .text = "# Continuous-time noise densities of one axis.\n"};
  file.text += figure_lines("", entry, file.notes);
  file.text += value_line("", "rostopic", yaml_string(entry.topic), "sensor_msgs/Imu");
  file.text += value_line("", "update_rate", yaml_float(entry.rate_hz), "Hz");
  file.next_command =
      "kalibr_calibrate_imu_camera --bag FILE.bag --cams camchain.yaml --imu imu.yaml --target target.yaml";
  return file;
}

bool recognizes(const YamlFile& file) {
  const YamlNode* imu = file.root.find("imu0");
  const YamlNode& figures = imu ? *imu : file.root;
  for (const char* key : {kAccelWhite, kAccelWalk, kGyroWhite, kGyroWalk}) {
    if (figures.find(key)) return true;
  }
  return false;
}

ImuNoiseEntry read_figures(ConfigMap& map) {
  map.accept_all({kAccelWhite, kAccelWalk, kGyroWhite, kGyroWalk, "rostopic", "update_rate", "rate_hz"});
  ImuNoiseEntry entry;
  entry.accel_white = plausible(map, kAccelWhite, map.positive(kAccelWhite, kAccelWhiteUnit), kAccelWhiteUnit);
  entry.gyro_white = plausible(map, kGyroWhite, map.positive(kGyroWhite, kGyroWhiteUnit), kGyroWhiteUnit);
  entry.accel_walk.value = plausible_walk(map, kAccelWalk, kAccelWalkUnit);
  entry.gyro_walk.value = plausible_walk(map, kGyroWalk, kGyroWalkUnit);
  entry.topic = map.text_or("rostopic", entry.topic);
  entry.rate_hz = map.positive(map.has("rate_hz") ? "rate_hz" : "update_rate", "Hz");
  return entry;
}

NoiseReading read(const YamlFile& file, const NoiseReadOptions&) {
  NoiseReading reading{.dialect = kName};
  ConfigMap root(file, file.root, "", reading.diagnostics);
  if (!root.has("imu0")) {
    root.accept_all({"sensor_type", "comment", "T_BS"});
    reading.entry = read_figures(root);
    root.warn_unknown();
    return reading;
  }
  ConfigMap imu = root.map("imu0");
  imu.accept_all({"T_i_b", "time_offset", "model", "gyroscopes", "accelerometers"});
  reading.entry = read_figures(imu);
  imu.warn_unknown();
  root.warn_unknown();
  return reading;
}

}  // namespace vispline::kalibr_noise

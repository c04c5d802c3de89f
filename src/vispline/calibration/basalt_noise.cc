#include "vispline/calibration/basalt_noise.h"

#include <algorithm>

#include "vispline/calibration/config_map.h"
#include "vispline/calibration/dialect_text.h"

namespace vispline::basalt_noise {
using namespace dialect;
namespace {

std::string triple(const char* key, double value) {
  const std::string number = yaml_float(value);
  return std::string(",\n    \"") + key + "\": [" + number + ", " + number + ", " + number + "]";
}

std::string walk_triple(const char* key, const WalkEntry& walk, std::vector<std::string>& notes) {
  if (!walk.value) notes.push_back(walk_note(key, walk));
  const auto value = written_walk(walk);
  return value ? triple(key, *value) : "";
}

double largest(ConfigMap& map, const char* key, const char* unit) {
  const std::vector<double> axes = map.numbers(key, 3, unit);
  const auto [least, most] = std::ranges::minmax(axes);
  if (!(least > 0.0)) map.fail(key, "holds " + brief(least) + ", expected positive numbers in " + unit);
  if (least < most) map.warn(key, "differs by axis: the largest, " + brief(most) + ", is used for all");
  return plausible(map, key, most, unit);
}

std::optional<double> largest_if(ConfigMap& map, const char* key, const char* unit) {
  if (map.has(key)) return largest(map, key, unit);
  return map.positive_or_warn(key, unit);
}

}  // namespace

NamedText write(const ImuNoiseEntry& entry) {
  NamedText file{.file_name = "basalt_imu.json"};
  file.text = "{\n  \"value0\": {\n    \"imu_update_rate\": " + yaml_float(entry.rate_hz);
  file.text += triple("accel_noise_std", entry.accel_white) + triple("gyro_noise_std", entry.gyro_white);
  file.text += walk_triple("accel_bias_std", entry.accel_walk, file.notes);
  file.text += walk_triple("gyro_bias_std", entry.gyro_walk, file.notes) + "\n  }\n}\n";
  file.notes.push_back(
      "a fragment: put its keys into value0 of calibration.json; units m/s^2/sqrt(Hz), "
      "rad/s/sqrt(Hz), m/s^3/sqrt(Hz), rad/s^2/sqrt(Hz), Hz");
  file.next_command =
      "basalt_vio --dataset-path FOLDER --dataset-type euroc --cam-calib calibration.json "
      "--config-path euroc_config.json";
  return file;
}

bool recognizes(const YamlFile& file) {
  const YamlNode* value = file.root.find("value0");
  return value && (value->find("imu_update_rate") || value->find("gyro_noise_std") || value->find("accel_noise_std"));
}

NoiseReading read(const YamlFile& file, const NoiseReadOptions&) {
  NoiseReading reading{.dialect = kName};
  ConfigMap root(file, file.root, "", reading.diagnostics);
  ConfigMap value = root.map("value0");
  value.accept_all({"accel_noise_std", "gyro_noise_std", "accel_bias_std", "gyro_bias_std", "imu_update_rate"});
  ImuNoiseEntry& entry = reading.entry;
  entry.accel_white = largest(value, "accel_noise_std", kAccelWhiteUnit);
  entry.gyro_white = largest(value, "gyro_noise_std", kGyroWhiteUnit);
  entry.accel_walk.value = largest_if(value, "accel_bias_std", kAccelWalkUnit);
  entry.gyro_walk.value = largest_if(value, "gyro_bias_std", kGyroWalkUnit);
  entry.rate_hz = value.positive("imu_update_rate", "Hz");
  value.accept_all({"T_imu_cam", "intrinsics", "resolution", "calib_accel_bias", "calib_gyro_bias", "T_mocap_world",
                    "T_imu_marker", "mocap_time_offset_ns", "mocap_to_imu_offset_ns", "cam_time_offset_ns",
                    "vignette"});
  value.warn_unknown();
  return reading;
}

}  // namespace vispline::basalt_noise

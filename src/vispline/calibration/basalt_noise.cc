#include "vispline/calibration/basalt_noise.h"

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

}  // namespace vispline::basalt_noise

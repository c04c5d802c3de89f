#include "vispline/calibration/openvins_noise.h"

#include "vispline/calibration/config_map.h"
#include "vispline/calibration/dialect_text.h"
#include "vispline/calibration/kalibr_noise.h"

namespace vispline::openvins_noise {
using namespace dialect;
namespace {

std::string matrix(const std::string& key, int size, double diagonal, const std::string& comment) {
  std::string text = "  " + key + ":" + (comment.empty() ? "" : "  # " + comment) + "\n";
  for (int row = 0; row < size; ++row) {
    text += "    - [";
    for (int col = 0; col < size; ++col) text += (col ? ", " : "") + yaml_float(row == col ? diagonal : 0.0);
    text += "]\n";
  }
  return text;
}

}  // namespace

NamedText write(const ImuNoiseEntry& entry) {
  NamedText file{.file_name = "kalibr_imu_chain.yaml", .text = "%YAML:1.0\n\nimu0:\n"};
  file.text += matrix("T_i_b", 4, 1.0, "body to IMU");
  file.text += kalibr_noise::figure_lines("  ", entry, file.notes);
  file.text += value_line("  ", "rostopic", yaml_string(entry.topic), "sensor_msgs/Imu");
  file.text += value_line("  ", "time_offset", yaml_float(0.0), "s");
  file.text += value_line("  ", "update_rate", yaml_float(entry.rate_hz), "Hz");
  file.text += value_line("  ", "model", "\"kalibr\"", "");
  file.text += matrix("Tw", 3, 1.0, "gyroscope scale and misalignment: none") + matrix("R_IMUtoGYRO", 3, 1.0, "");
  file.text += matrix("Ta", 3, 1.0, "accelerometer scale and misalignment: none") + matrix("R_IMUtoACC", 3, 1.0, "");
  file.text += matrix("Tg", 3, 0.0, "effect of acceleration on the gyroscope, rad/s per m/s^2: none");
  file.next_command = "ros2 launch ov_msckf subscribe.launch.py config_path:=FOLDER/estimator_config.yaml";
  return file;
}

bool recognizes(const YamlFile& file) {
  const YamlNode* imu = file.root.find("imu0");
  return imu && (file.is_opencv || imu->find("Tw") || imu->find("R_IMUtoGYRO"));
}

NoiseReading read(const YamlFile& file, const NoiseReadOptions&) {
  NoiseReading reading{.dialect = kName};
  ConfigMap root(file, file.root, "", reading.diagnostics);
  ConfigMap imu = root.map("imu0");
  imu.accept_all({"T_i_b", "time_offset", "model", "Tw", "R_IMUtoGYRO", "Ta", "R_IMUtoACC", "Tg"});
  reading.entry = kalibr_noise::read_figures(imu);
  imu.warn_unknown();
  root.warn_unknown();
  return reading;
}

}  // namespace vispline::openvins_noise

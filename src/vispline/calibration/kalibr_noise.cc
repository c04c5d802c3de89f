#include "vispline/calibration/kalibr_noise.h"

#include "vispline/calibration/dialect_text.h"

namespace vispline::kalibr_noise {
using namespace dialect;

std::string figure_lines(const std::string& indent, const ImuNoiseEntry& entry, std::vector<std::string>& notes) {
  return value_line(indent, "accelerometer_noise_density", yaml_float(entry.accel_white), "m/s^2/sqrt(Hz), white") +
         walk_line({indent, "accelerometer_random_walk", "m/s^3/sqrt(Hz), bias walk"}, entry.accel_walk, notes) +
         value_line(indent, "gyroscope_noise_density", yaml_float(entry.gyro_white), "rad/s/sqrt(Hz), white") +
         walk_line({indent, "gyroscope_random_walk", "rad/s^2/sqrt(Hz), bias walk"}, entry.gyro_walk, notes);
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

}  // namespace vispline::kalibr_noise

#include "vispline/calibration/orbslam3_noise.h"

#include "vispline/calibration/dialect_text.h"

namespace vispline::orbslam3_noise {
using namespace dialect;

NamedText write(const ImuNoiseEntry& entry) {
  NamedText file{.file_name = "orbslam3_imu.yaml"};
  file.text = "# For the settings file of ORB-SLAM3: replace the lines of the same keys. Continuous-time densities.\n";
  file.text += value_line("", "IMU.NoiseGyro", yaml_float(entry.gyro_white), "rad/s/sqrt(Hz)");
  file.text += value_line("", "IMU.NoiseAcc", yaml_float(entry.accel_white), "m/s^2/sqrt(Hz)");
  file.text += walk_line({"", "IMU.GyroWalk", "rad/s^2/sqrt(Hz)"}, entry.gyro_walk, file.notes);
  file.text += walk_line({"", "IMU.AccWalk", "m/s^3/sqrt(Hz)"}, entry.accel_walk, file.notes);
  file.text += value_line("", "IMU.Frequency", yaml_float(entry.rate_hz), "Hz");
  file.next_command = "mono_inertial_euroc ORBvoc.txt SETTINGS.yaml SEQUENCE TIMES.txt";
  return file;
}

}  // namespace vispline::orbslam3_noise

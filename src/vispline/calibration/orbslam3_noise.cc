#include "vispline/calibration/orbslam3_noise.h"

#include "vispline/calibration/config_map.h"
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

bool recognizes(const YamlFile& file) { return file.root.find("IMU.NoiseGyro") || file.root.find("IMU.NoiseAcc"); }

NoiseReading read(const YamlFile& file, const NoiseReadOptions&) {
  NoiseReading reading{.dialect = kName};
  ConfigMap root(file, file.root, "", reading.diagnostics);
  root.accept_all({"IMU.NoiseGyro", "IMU.NoiseAcc", "IMU.GyroWalk", "IMU.AccWalk", "IMU.Frequency", "IMU.T_b_c1",
                   "IMU.InsertKFsWhenLost", "IMU.fastInit"});
  ImuNoiseEntry& entry = reading.entry;
  entry.gyro_white = plausible(root, "IMU.NoiseGyro", root.positive("IMU.NoiseGyro", kGyroWhiteUnit), kGyroWhiteUnit);
  entry.accel_white = plausible(root, "IMU.NoiseAcc", root.positive("IMU.NoiseAcc", kAccelWhiteUnit), kAccelWhiteUnit);
  entry.gyro_walk.value = plausible_walk(root, "IMU.GyroWalk", kGyroWalkUnit);
  entry.accel_walk.value = plausible_walk(root, "IMU.AccWalk", kAccelWalkUnit);
  entry.rate_hz = root.positive("IMU.Frequency", "Hz");
  root.warn_unknown("IMU.");
  return reading;
}

}  // namespace vispline::orbslam3_noise

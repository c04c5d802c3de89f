#include "vispline/calibration/dialect_text.h"
#include "vispline/calibration/kalibr_noise.h"
#include "vispline/calibration/rig_checks.h"
#include "vispline/calibration/rig_dialects.h"
#include "vispline/calibration/rig_text.h"

namespace vispline::openvins_rig {
using namespace dialect;
namespace {

constexpr std::size_t kMostCameras = 16;
constexpr const char* kNext = "ros2 launch ov_msckf subscribe.launch.py config_path:=FOLDER/estimator_config.yaml";

CameraCalibration read_camera(ConfigMap map, const std::string& name) {
  CameraCalibration camera = kalibr_rig::read_camera(map, name);
  if (map.has("T_imu_cam")) camera.T_cam_imu = rig_checks::read_pose(map, "T_imu_cam").inverse();
  return camera;
}

Matrix3d matrix_or(ConfigMap& map, const char* key, const Matrix3d& absent) {
  return map.has(key) ? rig_checks::read_matrix3(map, key, "") : absent;
}

ImuCalibration read_imu(ConfigMap map) {
  ImuCalibration imu{.noise = kalibr_noise::read_figures(map)};
  map.accept("model");
  if (map.has("T_i_b")) imu.T_i_b = rig_checks::read_pose(map, "T_i_b");
  imu.time_offset = map.number_if("time_offset", "s").value_or(0.0);
  imu.gyro_M = matrix_or(map, "Tw", imu.gyro_M);
  imu.accel_M = matrix_or(map, "Ta", imu.accel_M);
  imu.gyro_A = matrix_or(map, "Tg", imu.gyro_A);
  imu.R_gyro_imu = rig_checks::checked_rotation(map, "R_IMUtoGYRO", matrix_or(map, "R_IMUtoGYRO", imu.R_gyro_imu));
  imu.R_accel_imu = rig_checks::checked_rotation(map, "R_IMUtoACC", matrix_or(map, "R_IMUtoACC", imu.R_accel_imu));
  map.warn_unknown();
  return imu;
}

void require_known_lens(const CameraCalibration& camera) {
  if (camera.model == "pinhole" && (camera.distortion_model == "radtan" || camera.distortion_model == "equidistant"))
    return;
  fail_rig("OpenVINS knows pinhole with radtan or equidistant, " + camera.name + " is " + camera.model + " with " +
           camera.distortion_model);
}

}  // namespace

bool recognizes(const YamlFile& file) {
  const YamlNode* imu = file.root.find("imu0");
  const YamlNode* camera = file.root.find("cam0");
  return (imu && (file.is_opencv || imu->find("Tw"))) || (camera && (file.is_opencv || camera->find("T_imu_cam")));
}

RigReading read(const RigInput& input) {
  RigReading reading;
  ConfigMap root(input.file, input.file.root, "", reading.diagnostics);
  for (const std::string& name : kalibr_rig::numbered_keys(root.node(), "cam")) {
    ConfigMap map = root.map(name);
    reading.rig.cameras.push_back(read_camera(map, name));
  }
  if (root.has("imu0")) reading.rig.imus.push_back(read_imu(root.map("imu0")));
  root.warn_unknown();
  return reading;
}

NamedText imu_chain(const ImuCalibration& imu) {
  NamedText file{.file_name = "kalibr_imu_chain.yaml", .text = "%YAML:1.0\n\nimu0:\n", .next_command = kNext};
  file.text += rows("  ", "T_i_b", matrix4(imu.T_i_b), "body to IMU, m");
  file.text += kalibr_noise::figure_lines("  ", imu.noise, file.notes);
  file.text += value_line("  ", "rostopic", yaml_string(imu.noise.topic), "sensor_msgs/Imu");
  file.text += value_line("  ", "time_offset", yaml_float(imu.time_offset), "s");
  file.text += value_line("  ", "update_rate", yaml_float(imu.noise.rate_hz), "Hz");
  file.text += value_line("  ", "model", "\"kalibr\"", "");
  file.text += rows("  ", "Tw", imu.gyro_M, "gyroscope scale and misalignment");
  file.text += rows("  ", "R_IMUtoGYRO", imu.R_gyro_imu, "IMU to gyroscope");
  file.text += rows("  ", "Ta", imu.accel_M, "accelerometer scale and misalignment");
  file.text += rows("  ", "R_IMUtoACC", imu.R_accel_imu, "IMU to accelerometer");
  file.text += rows("  ", "Tg", imu.gyro_A, "effect of acceleration on the gyroscope, rad/s per m/s^2");
  return file;
}

std::vector<NamedText> write(const RigCalibration& rig) {
  std::vector<NamedText> files;
  if (!rig.cameras.empty()) {
    require_rig(rig, "OpenVINS", kMostCameras);
    NamedText file{.file_name = "kalibr_imucam_chain.yaml", .text = "%YAML:1.0\n\n", .next_command = kNext};
    for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
      CameraCalibration camera = rig.cameras[i];
      require_known_lens(camera);
      camera.T_cam_imu = imu_to_camera(rig, i);
      file.text += "cam" + std::to_string(i) + ":\n" + kalibr_rig::camera_block(camera);
    }
    common_timeshift(rig, file.notes);
    note_lost_line_delay(rig, file.notes);
    files.push_back(file);
  }
  if (!rig.imus.empty()) files.push_back(imu_chain(rig.imus[0]));
  return files;
}

}  // namespace vispline::openvins_rig

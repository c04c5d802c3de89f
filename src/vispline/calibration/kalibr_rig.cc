#include "vispline/calibration/dialect_text.h"
#include "vispline/calibration/kalibr_noise.h"
#include "vispline/calibration/noise_files.h"
#include "vispline/calibration/rig_checks.h"
#include "vispline/calibration/rig_dialects.h"
#include "vispline/calibration/rig_text.h"

namespace vispline::kalibr_rig {
using namespace dialect;
namespace {

std::string integers(const int* first, std::size_t count) {
  std::string text = "[";
  for (std::size_t i = 0; i < count; ++i) text += (i ? ", " : "") + std::to_string(first[i]);
  return text + "]";
}

std::string imu_block(const ImuCalibration& imu, std::vector<std::string>& notes) {
  std::string text = rows("  ", "T_i_b", matrix4(imu.T_i_b), "body to IMU, m");
  text += kalibr_noise::figure_lines("  ", imu.noise, notes);
  text += value_line("  ", "rostopic", yaml_string(imu.noise.topic), "sensor_msgs/Imu");
  text += value_line("  ", "time_offset", yaml_float(imu.time_offset), "s, to imu0");
  text += value_line("  ", "update_rate", yaml_float(imu.noise.rate_hz), "Hz");
  text += value_line("  ", "model", is_ideal(imu) ? "calibrated" : "scale-misalignment", "");
  if (imu.R_accel_imu != Matrix3d::Identity()) {
    notes.push_back("the rotation of the accelerometer is lost: Kalibr takes it for the axes of the IMU");
  }
  if (is_ideal(imu)) return text;
  text += "  gyroscopes:\n" + rows("    ", "M", imu.gyro_M, "") + rows("    ", "A", imu.gyro_A, "rad/s per m/s^2");
  text += rows("    ", "C_gyro_i", imu.R_gyro_imu, "IMU to gyroscope");
  return text + "  accelerometers:\n" + rows("    ", "M", imu.accel_M, "");
}

void read_intrinsics(ConfigMap& map, ImuCalibration& imu) {
  if (map.has("gyroscopes")) {
    ConfigMap gyro = map.map("gyroscopes");
    imu.gyro_M = rig_checks::read_matrix3(gyro, "M", "");
    if (gyro.has("A")) imu.gyro_A = rig_checks::read_matrix3(gyro, "A", "rad/s per m/s^2");
    const Matrix3d R = rig_checks::read_matrix3(gyro, "C_gyro_i", "");
    imu.R_gyro_imu = rig_checks::checked_rotation(gyro, "C_gyro_i", R);
    gyro.warn_unknown();
  }
  if (!map.has("accelerometers")) return;
  ConfigMap accel = map.map("accelerometers");
  imu.accel_M = rig_checks::read_matrix3(accel, "M", "");
  accel.warn_unknown();
}

ImuCalibration read_imu(ConfigMap map, const std::string& name) {
  ImuCalibration imu{.noise = kalibr_noise::read_figures(map)};
  imu.noise.name = name;
  map.accept("model");
  if (map.has("T_i_b")) imu.T_i_b = rig_checks::read_pose(map, "T_i_b");
  imu.time_offset = map.number_if("time_offset", "s").value_or(0.0);
  read_intrinsics(map, imu);
  map.warn_unknown();
  return imu;
}

}  // namespace

std::string camera_block(const CameraCalibration& camera) {
  std::string text;
  if (camera.T_cam_imu) text += rows("  ", "T_cam_imu", matrix4(*camera.T_cam_imu), "IMU to camera, m");
  if (camera.T_cn_cnm1) text += rows("  ", "T_cn_cnm1", matrix4(*camera.T_cn_cnm1), "camera before to this one, m");
  text += value_line("  ", "cam_overlaps", integers(camera.overlaps.data(), camera.overlaps.size()), "");
  text += value_line("  ", "camera_model", camera.model, "");
  text += value_line("  ", "distortion_coeffs", list(camera.distortion), "");
  text += value_line("  ", "distortion_model", camera.distortion_model, "");
  text += value_line("  ", "intrinsics", list(camera.intrinsics), "");
  text += value_line("  ", "resolution", integers(camera.resolution_px.data(), 2), "px, width and height");
  if (!camera.topic.empty()) text += value_line("  ", "rostopic", yaml_string(camera.topic), "");
  if (const auto shift = camera.timeshift_cam_imu) {
    text += value_line("  ", "timeshift_cam_imu", yaml_float(*shift), "s: t_imu = t_cam + timeshift");
  }
  if (const auto delay = camera.line_delay)
    text += value_line("  ", "line_delay", yaml_float(*delay), "s from row to row");
  return text;
}

CameraCalibration read_camera(ConfigMap map, const std::string& name) {
  CameraCalibration camera{.name = name};
  camera.model = map.text("camera_model");
  camera.intrinsics = map.numbers("intrinsics", 0, "px");
  camera.distortion_model = map.text_or("distortion_model", "none");
  const YamlNode* coefficients = map.node().find("distortion_coeffs");
  map.accept("distortion_coeffs");
  if (coefficients && !coefficients->items.empty()) camera.distortion = map.numbers("distortion_coeffs", 0, "");
  const std::vector<int> side = map.integers("resolution", 0, 1 << 30);
  if (side.size() != 2)
    map.fail("resolution", "has " + std::to_string(side.size()) + " numbers, expected [width, height]");
  camera.resolution_px = {side[0], side[1]};
  rig_checks::require_possible(map, "intrinsics", camera);
  if (map.has("T_cam_imu")) camera.T_cam_imu = rig_checks::read_pose(map, "T_cam_imu");
  if (map.has("T_cn_cnm1")) camera.T_cn_cnm1 = rig_checks::read_pose(map, "T_cn_cnm1");
  camera.timeshift_cam_imu = map.number_if("timeshift_cam_imu", "s");
  camera.line_delay = map.number_if("line_delay", "s");
  if (map.has("cam_overlaps")) camera.overlaps = map.integers("cam_overlaps", 0, 1 << 20);
  camera.topic = map.text_or("rostopic", "");
  return camera;
}

std::vector<std::string> numbered_keys(const YamlNode& root, const std::string& stem) {
  std::vector<std::string> keys;
  while (root.find(stem + std::to_string(keys.size()))) keys.push_back(stem + std::to_string(keys.size()));
  return keys;
}

bool recognizes(const YamlFile& file) {
  return file.root.find("cam0") || file.root.find("imu0") || kalibr_noise::recognizes(file);
}

RigReading read(const RigInput& input) {
  RigReading reading;
  ConfigMap root(input.file, input.file.root, "", reading.diagnostics);
  for (const std::string& name : numbered_keys(root.node(), "cam")) {
    ConfigMap map = root.map(name);
    reading.rig.cameras.push_back(read_camera(map, name));
    map.accept_all({"camera_model", "intrinsics", "distortion_model", "distortion_coeffs", "resolution", "T_cam_imu",
                    "T_cn_cnm1", "timeshift_cam_imu", "line_delay", "cam_overlaps", "rostopic"});
    map.warn_unknown();
  }
  for (const std::string& name : numbered_keys(root.node(), "imu")) {
    reading.rig.imus.push_back(read_imu(root.map(name), name));
  }
  if (reading.rig.cameras.empty() && reading.rig.imus.empty()) {
    reading.rig.imus.push_back({.noise = kalibr_noise::read_figures(root)});
  }
  root.warn_unknown();
  return reading;
}

std::vector<NamedText> write(const RigCalibration& rig) {
  std::vector<NamedText> files;
  const char* next =
      "kalibr_calibrate_imu_camera --bag FILE.bag --cams camchain.yaml --imu imu.yaml --target target.yaml";
  if (!rig.cameras.empty()) {
    NamedText file{.file_name = "camchain.yaml", .next_command = next};
    for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
      file.text += "cam" + std::to_string(i) + ":\n" + camera_block(rig.cameras[i]);
    }
    files.push_back(file);
  }
  if (rig.imus.empty()) return files;
  NamedText file{.file_name = "imu-chain.yaml", .next_command = next};
  file.notes.push_back("the form of Kalibr's results, for programs that read those; Kalibr itself takes imu.yaml");
  for (std::size_t i = 0; i < rig.imus.size(); ++i) {
    file.text += "imu" + std::to_string(i) + ":\n" + imu_block(rig.imus[i], file.notes);
  }
  files.push_back(file);
  files.push_back(noise_file("kalibr", rig.imus[0].noise));
  return files;
}

}  // namespace vispline::kalibr_rig

#include "vispline/calibration/rig_files.h"

#include <cmath>

#include "vispline/calibration/dialect_text.h"
#include "vispline/calibration/rig_checks.h"
#include "vispline/calibration/rig_dialects.h"
#include "vispline/calibration/yaml_error.h"
#include "vispline/files/small_file.h"

namespace vispline {
namespace {

struct Dialect {
  const char* name;
  bool (*recognizes)(const YamlFile&);
  RigReading (*read)(const RigInput&);
  std::vector<NamedText> (*write)(const RigCalibration&);
};

/// The more special first.
constexpr Dialect kDialects[] = {
    {gyroflow_rig::kName, gyroflow_rig::recognizes, gyroflow_rig::read, gyroflow_rig::write},
    {basalt_rig::kName, basalt_rig::recognizes, basalt_rig::read, basalt_rig::write},
    {orbslam3_rig::kName, orbslam3_rig::recognizes, orbslam3_rig::read, orbslam3_rig::write},
    {vins_fusion_rig::kName, vins_fusion_rig::recognizes, vins_fusion_rig::read, vins_fusion_rig::write},
    {openvins_rig::kName, openvins_rig::recognizes, openvins_rig::read, openvins_rig::write},
    {kalibr_rig::kName, kalibr_rig::recognizes, kalibr_rig::read, kalibr_rig::write},
};

std::string known_dialects() {
  std::string known;
  for (const std::string& name : rig_dialects()) known += (known.empty() ? "" : ", ") + name;
  return known;
}

/// Of files beside `path` and nowhere else.
SiblingText siblings_of(const std::string& path) {
  const std::string folder = path.substr(0, path.rfind('/') == std::string::npos ? 0 : path.rfind('/') + 1);
  return [folder](const std::string& name) { return read_small_text_file(folder + name, yaml_limits::kBytes); };
}

}  // namespace

void fail_rig(const std::string& message, const std::string& next) {
  throw Error(ExitCode::kUsage,
              {.code = "E-CONFIG", .message = message, .where = "", .effect = "nothing written", .next = next});
}

void require_rig(const RigCalibration& rig, const std::string& tool, std::size_t cameras) {
  if (rig.cameras.empty() || rig.cameras.size() > cameras) {
    fail_rig(tool + " takes 1 to " + std::to_string(cameras) + " cameras, the rig has " +
             std::to_string(rig.cameras.size()));
  }
  if (rig.imus.size() > 1) fail_rig(tool + " takes one IMU, the rig has " + std::to_string(rig.imus.size()));
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    if (!imu_to_camera(rig, i)) fail_rig(rig.cameras[i].name + " has no T_cam_imu, which " + tool + " needs");
  }
}

double common_timeshift(const RigCalibration& rig, std::vector<std::string>& notes) {
  const double shift = rig.cameras[0].timeshift_cam_imu.value_or(0.0);
  for (const CameraCalibration& camera : rig.cameras) {
    const double other = camera.timeshift_cam_imu.value_or(0.0);
    if (std::abs(other - shift) < 1e-9) continue;
    notes.push_back("only the time shift of " + rig.cameras[0].name + ", " + dialect::brief(shift) + " s, is used; " +
                    camera.name + " has " + dialect::brief(other) + " s");
  }
  return shift;
}

void note_lost_line_delay(const RigCalibration& rig, std::vector<std::string>& notes) {
  for (const CameraCalibration& camera : rig.cameras) {
    if (camera.line_delay.value_or(0.0) != 0.0) notes.push_back("the line delay of " + camera.name + " is lost");
  }
}

void note_lost_imu_model(const RigCalibration& rig, std::vector<std::string>& notes) {
  if (rig.imus.empty()) return;
  const ImuCalibration& imu = rig.imus[0];
  if (!is_ideal(imu)) notes.push_back("scale and misalignment of the IMU are lost: correct its readings first");
  if (imu.T_i_b.R != Matrix3d::Identity() || imu.T_i_b.p != Vector3d::Zero()) {
    notes.push_back("T_i_b is lost: the IMU is the body");
  }
}

std::vector<std::string> rig_dialects() {
  return {"kalibr", "openvins", "vins-fusion", "orbslam3", "basalt", "gyroflow"};
}

std::vector<NamedText> rig_files(std::string_view dialect, const RigCalibration& rig) {
  for (const Dialect& row : kDialects) {
    if (dialect != row.name) continue;
    for (const CameraCalibration& camera : rig.cameras) {
      const std::string problem = rig_checks::problem_of(camera);
      if (!problem.empty()) fail_rig(camera.name + " cannot be: " + problem);
    }
    return row.write(rig);
  }
  fail_rig("unknown kind of calibration file " + vispline::quoted(dialect), "choose one of: " + known_dialects());
}

RigReading parse_rig(std::string path, std::string_view text, const SiblingText& sibling,
                     const RigReadOptions& options) {
  const YamlFile file = parse_yaml(std::move(path), text);
  for (const Dialect& row : kDialects) {
    if (!row.recognizes(file)) continue;
    RigReading reading = row.read({file, sibling, options});
    reading.dialect = row.name;
    return reading;
  }
  fail_config("no camera or IMU in the file", file.path, "it can be a file of: " + known_dialects());
}

RigReading read_rig_file(const std::string& path, const RigReadOptions& options) {
  return parse_rig(path, read_small_text_file(path, yaml_limits::kBytes), siblings_of(path), options);
}

}  // namespace vispline

#include <cmath>

#include "vispline/calibration/basalt_noise.h"
#include "vispline/calibration/dialect_text.h"
#include "vispline/calibration/noise_files.h"
#include "vispline/calibration/rig_checks.h"
#include "vispline/calibration/rig_dialects.h"

namespace vispline::basalt_rig {
using namespace dialect;
namespace {

constexpr std::size_t kMostCameras = 16;

/// Basalt names every parameter: fx fy cx cy, what Kalibr has before them, and the distortion.
struct Lens {
  const char* type;
  const char* model;
  const char* distortion_model;
  std::vector<const char*> before;
  std::vector<const char*> distortion;
};

const Lens kLenses[] = {
    {"ds", "ds", "none", {"xi", "alpha"}, {}},
    {"eucm", "eucm", "none", {"alpha", "beta"}, {}},
    {"kb4", "pinhole", "equidistant", {}, {"k1", "k2", "k3", "k4"}},
    {"pinhole", "pinhole", "none", {}, {}},
};
constexpr const char* kProjection[] = {"fx", "fy", "cx", "cy"};

const Lens& lens_of(const CameraCalibration& camera) {
  for (const Lens& lens : kLenses) {
    if (camera.model == lens.model && camera.distortion_model == lens.distortion_model) return lens;
  }
  fail_rig("Basalt knows ds and eucm, and pinhole with equidistant or none, " + camera.name + " is " + camera.model +
           " with " + camera.distortion_model);
}

std::string pair(const char* key, double value, bool first = false) {
  return std::string(first ? "" : ", ") + "\"" + key + "\": " + yaml_float(value);
}

std::string lens_text(const CameraCalibration& camera) {
  const Lens& lens = lens_of(camera);
  const auto projection = projection_of(camera);
  std::string text = std::string("{\"camera_type\": \"") + lens.type + "\", \"intrinsics\": {";
  for (std::size_t i = 0; i < 4; ++i) text += pair(kProjection[i], projection[i], i == 0);
  for (std::size_t i = 0; i < lens.before.size(); ++i) text += pair(lens.before[i], camera.intrinsics[i]);
  for (std::size_t i = 0; i < lens.distortion.size(); ++i) text += pair(lens.distortion[i], camera.distortion[i]);
  return text + "}}";
}

std::string pose_text(const Pose& T) {
  const Eigen::Quaterniond q = T.quaternion().normalized();
  return "{" + pair("px", T.p.x(), true) + pair("py", T.p.y()) + pair("pz", T.p.z()) + pair("qx", q.x()) +
         pair("qy", q.y()) + pair("qz", q.z()) + pair("qw", q.w()) + "}";
}

/// "key": [\n items \n]
template <class Item>
std::string array(const char* key, const RigCalibration& rig, const Item& item) {
  std::string text = std::string("    \"") + key + "\": [";
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) text += (i ? ",\n      " : "\n      ") + item(i);
  return text + "\n    ],\n";
}

std::string zeros(const char* key, int count) {
  std::string text = std::string("    \"") + key + "\": [0.0";
  for (int i = 1; i < count; ++i) text += ", 0.0";
  return text + "],\n";
}

CameraCalibration read_lens(ConfigMap map) {
  const std::string type = map.text("camera_type");
  for (const Lens& lens : kLenses) {
    if (type != lens.type) continue;
    CameraCalibration camera{.model = lens.model, .distortion_model = lens.distortion_model};
    ConfigMap numbers = map.map("intrinsics");
    for (const char* key : lens.before) camera.intrinsics.push_back(numbers.number(key, ""));
    for (const char* key : kProjection) camera.intrinsics.push_back(numbers.number(key, "px"));
    for (const char* key : lens.distortion) camera.distortion.push_back(numbers.number(key, ""));
    numbers.warn_unknown();
    return camera;
  }
  map.fail("camera_type", "is " + vispline::quoted(type) + ", expected ds, eucm, kb4 or pinhole");
}

Pose read_pose(ConfigMap map) {
  Vector3d p;
  Eigen::Quaterniond q;
  const char* const axes[] = {"px", "py", "pz"};
  const char* const parts[] = {"qx", "qy", "qz", "qw"};
  for (int i = 0; i < 3; ++i) p[i] = map.number(axes[i], "m");
  for (int i = 0; i < 4; ++i) q.coeffs()[i] = map.number(parts[i], "");
  const double off = std::abs(q.norm() - 1.0);
  if (!(off <= 1e-3)) map.fail("qw", "belongs to a quaternion of length " + brief(q.norm()) + ", expected 1");
  if (off > 1e-6) map.warn("qw", "belongs to a quaternion of length " + brief(q.norm()) + ": it is made 1");
  return {q.normalized().toRotationMatrix(), p};
}

std::array<int, 2> read_resolution(ConfigMap& map, const YamlNode& list, std::size_t index) {
  std::array<int, 2> side{};
  const bool fits =
      list.kind == YamlNode::Kind::kSequence && index < list.items.size() && list.items[index].items.size() == 2;
  if (!fits) map.fail("resolution", "has no width and height for camera " + std::to_string(index));
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string& text = list.items[index].items[i].text;
    const bool is_number = !text.empty() && text.size() <= 5 && text.find_first_not_of("0123456789") == text.npos;
    if (!is_number) map.fail("resolution", "holds " + vispline::quoted(text) + ", expected whole numbers of px");
    side[i] = std::stoi(text);
  }
  return side;
}

}  // namespace

bool recognizes(const YamlFile& file) { return file.root.find("value0") != nullptr; }

RigReading read(const RigInput& input) {
  RigReading reading;
  ConfigMap root(input.file, input.file.root, "", reading.diagnostics);
  ConfigMap value = root.map("value0");
  const std::vector<ConfigMap> poses = value.maps("T_imu_cam"), lenses = value.maps("intrinsics");
  if (poses.size() != lenses.size()) value.fail("T_imu_cam", "has not as many entries as intrinsics");
  const double shift = value.number_if("cam_time_offset_ns", "ns").value_or(0.0) * 1e-9;
  value.accept("resolution");
  const YamlNode* resolution = value.node().find("resolution");
  if (!resolution) value.fail("resolution", "is missing");
  for (std::size_t i = 0; i < poses.size(); ++i) {
    CameraCalibration camera = read_lens(lenses[i]);
    camera.name = "cam" + std::to_string(i);
    camera.resolution_px = read_resolution(value, *resolution, i);
    camera.T_cam_imu = read_pose(poses[i]).inverse();
    camera.timeshift_cam_imu = shift;
    rig_checks::require_possible(value, "intrinsics", camera);
    reading.rig.cameras.push_back(camera);
  }
  if (!basalt_noise::recognizes(input.file)) return reading;
  NoiseReading noise = basalt_noise::read(input.file, {});
  reading.diagnostics.merge(noise.diagnostics);
  reading.rig.imus.push_back({.noise = noise.entry});
  return reading;
}

std::vector<NamedText> write(const RigCalibration& rig) {
  require_rig(rig, "Basalt", kMostCameras);
  NamedText file{.file_name = "calibration.json",
                 .next_command =
                     "basalt_vio --dataset-path FOLDER --dataset-type euroc --cam-calib calibration.json "
                     "--config-path euroc_config.json"};
  file.text = "{\n  \"value0\": {\n";
  file.text += array("T_imu_cam", rig, [&](std::size_t i) { return pose_text(imu_to_camera(rig, i)->inverse()); });
  file.text += array("intrinsics", rig, [&](std::size_t i) { return lens_text(rig.cameras[i]); });
  file.text += array("resolution", rig, [&](std::size_t i) {
    const auto& side = rig.cameras[i].resolution_px;
    return "[" + std::to_string(side[0]) + ", " + std::to_string(side[1]) + "]";
  });
  file.text += zeros("calib_accel_bias", 9) + zeros("calib_gyro_bias", 12);
  const double shift = common_timeshift(rig, file.notes);
  file.text += "    \"vignette\": [],\n    \"cam_time_offset_ns\": " + std::to_string(std::llround(shift * 1e9));
  if (!rig.imus.empty()) {
    const NamedText noise = noise_file("basalt", rig.imus[0].noise);
    const std::string head = "\"value0\": {";
    const std::size_t begin = noise.text.find(head) + head.size(), end = noise.text.rfind("\n  }\n}");
    file.text += "," + noise.text.substr(begin, end - begin);
    file.notes.insert(file.notes.end(), noise.notes.begin(), noise.notes.end() - 1);
  }
  file.text += "\n  }\n}\n";
  if (shift != 0.0) {
    file.notes.push_back("basalt_vio holds the time offset but does not apply it: add " + brief(shift) +
                         " s to the stamps of the images");
  }
  note_lost_line_delay(rig, file.notes);
  note_lost_imu_model(rig, file.notes);
  return {file};
}

}  // namespace vispline::basalt_rig

#include <cmath>

#include "vispline/calibration/dialect_text.h"
#include "vispline/calibration/noise_files.h"
#include "vispline/calibration/rig_checks.h"
#include "vispline/calibration/rig_dialects.h"
#include "vispline/calibration/rig_text.h"
#include "vispline/calibration/vins_fusion_noise.h"
#include "vispline/calibration/yaml_error.h"

namespace vispline::vins_fusion_rig {
using namespace dialect;
namespace {

/// A lens of camodocal: the names of its parameters in the order of CameraCalibration.
struct Lens {
  const char* type;
  const char* model;
  const char* distortion_model;
  const char* distortion_map;  ///< null: both sets stand in projection_parameters
  std::vector<const char*> distortion;
  std::vector<const char*> projection;
  const char* mirror;  ///< xi, in a map of its own
};

const Lens kLenses[] = {
    {"PINHOLE",
     "pinhole",
     "radtan",
     "distortion_parameters",
     {"k1", "k2", "p1", "p2"},
     {"fx", "fy", "cx", "cy"},
     nullptr},
    {"MEI",
     "omni",
     "radtan",
     "distortion_parameters",
     {"k1", "k2", "p1", "p2"},
     {"gamma1", "gamma2", "u0", "v0"},
     "xi"},
    {"KANNALA_BRANDT", "pinhole", "equidistant", nullptr, {"k2", "k3", "k4", "k5"}, {"mu", "mv", "u0", "v0"}, nullptr},
};

const Lens& lens_of(const CameraCalibration& camera) {
  for (const Lens& lens : kLenses) {
    const bool plain = camera.distortion_model == "none" && lens.distortion_model == std::string("radtan");
    if (camera.model == lens.model && (plain || camera.distortion_model == lens.distortion_model)) return lens;
  }
  fail_rig("VINS-Fusion knows pinhole and omni with radtan and pinhole with equidistant, " + camera.name + " is " +
           camera.model + " with " + camera.distortion_model);
}

std::string parameters(const std::vector<const char*>& names, const double* values) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) text += value_line("   ", names[i], yaml_float(values[i]), "");
  return text;
}

std::string camera_text(const CameraCalibration& camera, const Lens& lens) {
  std::vector<double> distortion = camera.distortion;
  distortion.resize(lens.distortion.size(), 0.0);
  const auto projection = projection_of(camera);
  std::string text = std::string("%YAML:1.0\n---\nmodel_type: ") + lens.type + "\n";
  text += value_line("", "camera_name", yaml_string(slug(camera.name)), "");
  text += value_line("", "image_width", std::to_string(camera.resolution_px[0]), "px");
  text += value_line("", "image_height", std::to_string(camera.resolution_px[1]), "px");
  if (lens.mirror)
    text += "mirror_parameters:\n" + value_line("   ", lens.mirror, yaml_float(camera.intrinsics[0]), "");
  if (lens.distortion_map) text += "distortion_parameters:\n" + parameters(lens.distortion, distortion.data());
  text += "projection_parameters:\n";
  if (!lens.distortion_map) text += parameters(lens.distortion, distortion.data());
  return text + parameters(lens.projection, projection.data());
}

void read_parameters(ConfigMap& map, const std::vector<const char*>& names, std::vector<double>& values) {
  for (const char* name : names) values.push_back(map.number(name, ""));
}

CameraCalibration parse_camera(const YamlFile& file, const std::string& name, Diagnostics& diagnostics) {
  ConfigMap root(file, file.root, "", diagnostics);
  const std::string type = root.text("model_type");
  for (const Lens& lens : kLenses) {
    if (type != lens.type) continue;
    CameraCalibration camera{.name = name, .model = lens.model, .distortion_model = lens.distortion_model};
    if (lens.mirror) camera.intrinsics.push_back(root.map("mirror_parameters").number(lens.mirror, ""));
    ConfigMap projection = root.map("projection_parameters");
    if (lens.distortion_map) {
      ConfigMap distortion = root.map(lens.distortion_map);
      read_parameters(distortion, lens.distortion, camera.distortion);
    } else {
      read_parameters(projection, lens.distortion, camera.distortion);
    }
    read_parameters(projection, lens.projection, camera.intrinsics);
    camera.resolution_px = {root.integer("image_width", "px", 0, 1 << 30),
                            root.integer("image_height", "px", 0, 1 << 30)};
    root.accept("camera_name");
    root.warn_unknown();
    rig_checks::require_possible(root, "projection_parameters", camera);
    return camera;
  }
  root.fail("model_type", "is " + vispline::quoted(type) + ", expected PINHOLE, MEI or KANNALA_BRANDT");
}

/// Only a name of a file beside the configuration.
void require_plain_name(const ConfigMap& root, const std::string& key, const std::string& name) {
  if (!name.empty() && name[0] != '.' && name.find('/') == std::string::npos && name.find('\0') == std::string::npos)
    return;
  throw Error(ExitCode::kInput,
              {.code = "E-PATH",
               .message = key + " names " + vispline::quoted(name) + ", expected a file beside this one",
               .where = root.where(key),
               .effect = "nothing read",
               .next = ""});
}

CameraCalibration read_camera(const RigInput& input, ConfigMap& root, int index, Diagnostics& diagnostics) {
  const std::string name = "cam" + std::to_string(index);
  const std::string file_name = root.text(name + "_calib");
  require_plain_name(root, name + "_calib", file_name);
  const YamlFile file = parse_yaml(file_name, input.sibling(file_name));
  CameraCalibration camera = parse_camera(file, name, diagnostics);
  camera.T_cam_imu = rig_checks::read_pose(root, "body_T_" + name).inverse();
  camera.timeshift_cam_imu = root.number_if("td", "s");
  camera.topic = root.text_or("image" + std::to_string(index) + "_topic", "");
  return camera;
}

}  // namespace

bool recognizes(const YamlFile& file) { return file.root.find("body_T_cam0") || file.root.find("cam0_calib"); }

RigReading read(const RigInput& input) {
  RigReading reading;
  ConfigMap root(input.file, input.file.root, "", reading.diagnostics);
  const int cameras = root.integer("num_of_cam", "", 1, 2);
  for (int i = 0; i < cameras; ++i) reading.rig.cameras.push_back(read_camera(input, root, i, reading.diagnostics));
  if (!vins_fusion_noise::recognizes(input.file)) return reading;
  if (!input.options.rate_hz) {
    root.warn("acc_n", "and the other figures of the IMU are those of one sample: not read without its rate");
    return reading;
  }
  NoiseReading noise = vins_fusion_noise::read(input.file, {.rate_hz = input.options.rate_hz});
  reading.diagnostics.merge(noise.diagnostics);
  reading.rig.imus.push_back({.noise = noise.entry});
  return reading;
}

std::vector<NamedText> write(const RigCalibration& rig) {
  require_rig(rig, "VINS-Fusion", 2);
  std::vector<NamedText> files{
      {.file_name = "vins_fusion.yaml", .next_command = "rosrun vins vins_node vins_fusion.yaml"}};
  NamedText& config = files[0];
  config.text = "%YAML:1.0\n\nimu: 1\nnum_of_cam: " + std::to_string(rig.cameras.size()) + "\n";
  if (!rig.imus.empty()) config.text += value_line("", "imu_topic", yaml_string(rig.imus[0].noise.topic), "");
  config.text += value_line("", "image_width", std::to_string(rig.cameras[0].resolution_px[0]), "px");
  config.text += value_line("", "image_height", std::to_string(rig.cameras[0].resolution_px[1]), "px");
  std::vector<NamedText> cameras;
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    const CameraCalibration& camera = rig.cameras[i];
    const std::string n = std::to_string(i), name = "cam" + n + ".yaml";
    if (!camera.topic.empty()) config.text += value_line("", "image" + n + "_topic", yaml_string(camera.topic), "");
    config.text += value_line("", "cam" + n + "_calib", "\"" + name + "\"", "");
    config.text +=
        opencv_matrix("body_T_cam" + n, imu_to_camera(rig, i)->inverse(), 'd', "camera to IMU (the body), m");
    cameras.push_back(
        {.file_name = name, .text = camera_text(camera, lens_of(camera)), .next_command = config.next_command});
  }
  config.text += "estimate_extrinsic: 0  # 0: as given above\nestimate_td: 0  # 0: as given below\n";
  config.text += value_line("", "td", yaml_float(common_timeshift(rig, config.notes)), "s: t_imu = t_image + td");
  note_lost_line_delay(rig, config.notes);
  note_lost_imu_model(rig, config.notes);
  config.notes.push_back(
      "put the settings of the tracker and the solver from a configuration that VINS-Fusion ships below it");
  if (!rig.imus.empty()) {
    const NamedText noise = noise_file("vins-fusion", rig.imus[0].noise);
    config.text += noise.text;
    config.notes.insert(config.notes.end(), noise.notes.begin(), noise.notes.end());
  }
  files.insert(files.end(), cameras.begin(), cameras.end());
  return files;
}

}  // namespace vispline::vins_fusion_rig

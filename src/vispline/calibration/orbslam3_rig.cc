#include "vispline/calibration/dialect_text.h"
#include "vispline/calibration/noise_files.h"
#include "vispline/calibration/orbslam3_noise.h"
#include "vispline/calibration/rig_checks.h"
#include "vispline/calibration/rig_dialects.h"
#include "vispline/calibration/rig_text.h"

namespace vispline::orbslam3_rig {
using namespace dialect;
namespace {

struct Lens {
  const char* type;
  const char* distortion_model;
  std::vector<const char*> distortion;
};

const Lens kLenses[] = {
    {"PinHole", "radtan", {"k1", "k2", "p1", "p2"}},
    {"KannalaBrandt8", "equidistant", {"k1", "k2", "k3", "k4"}},
};
constexpr const char* kProjection[] = {"fx", "fy", "cx", "cy"};

const Lens& lens_of(const CameraCalibration& camera) {
  for (const Lens& lens : kLenses) {
    const bool plain = camera.distortion_model == "none" && lens.type == std::string("PinHole");
    if (camera.model == "pinhole" && (plain || camera.distortion_model == lens.distortion_model)) return lens;
  }
  fail_rig("ORB-SLAM3 knows pinhole with radtan or equidistant, " + camera.name + " is " + camera.model + " with " +
           camera.distortion_model);
}

std::string lens_lines(const std::string& prefix, const CameraCalibration& camera, const Lens& lens) {
  std::string text;
  for (std::size_t i = 0; i < 4; ++i)
    text += value_line("", prefix + kProjection[i], yaml_float(camera.intrinsics[i]), "px");
  for (std::size_t i = 0; i < camera.distortion.size(); ++i) {
    text += value_line("", prefix + lens.distortion[i], yaml_float(camera.distortion[i]), "");
  }
  return text;
}

CameraCalibration read_lens(ConfigMap& root, const std::string& prefix, const Lens& lens) {
  CameraCalibration camera{.distortion_model = lens.distortion_model};
  for (const char* key : kProjection) camera.intrinsics.push_back(root.number(prefix + key, "px"));
  const bool plain = lens.type == std::string("PinHole") && !root.has(prefix + "k1");
  if (plain) camera.distortion_model = "none";
  if (!plain) {
    for (const char* key : lens.distortion) camera.distortion.push_back(root.number(prefix + key, ""));
  }
  camera.resolution_px = {root.integer("Camera.width", "px", 0, 1 << 30),
                          root.integer("Camera.height", "px", 0, 1 << 30)};
  if (lens.type == std::string("PinHole") && root.has(prefix + "k3") && root.number(prefix + "k3", "") != 0.0) {
    root.fail(prefix + "k3", "is not 0: radtan has k1 k2 p1 p2 only");
  }
  rig_checks::require_possible(root, prefix + "fx", camera);
  return camera;
}

}  // namespace

bool recognizes(const YamlFile& file) { return file.root.find("Camera1.fx") != nullptr; }

RigReading read(const RigInput& input) {
  RigReading reading;
  ConfigMap root(input.file, input.file.root, "", reading.diagnostics);
  const std::string type = root.text("Camera.type");
  const Lens* lens = type == kLenses[0].type ? &kLenses[0] : type == kLenses[1].type ? &kLenses[1] : nullptr;
  if (!lens) root.fail("Camera.type", "is " + vispline::quoted(type) + ", expected PinHole or KannalaBrandt8");
  auto& cameras = reading.rig.cameras;
  cameras.push_back(read_lens(root, "Camera1.", *lens));
  if (root.has("IMU.T_b_c1")) cameras[0].T_cam_imu = rig_checks::read_pose(root, "IMU.T_b_c1").inverse();
  if (root.has("Camera2.fx")) {
    cameras.push_back(read_lens(root, "Camera2.", *lens));
    cameras[1].name = "cam1";
    if (root.has("Stereo.T_c1_c2")) cameras[1].T_cn_cnm1 = rig_checks::read_pose(root, "Stereo.T_c1_c2").inverse();
  }
  if (!orbslam3_noise::recognizes(input.file)) return reading;
  NoiseReading noise = orbslam3_noise::read(input.file, {});
  reading.diagnostics.merge(noise.diagnostics);
  reading.rig.imus.push_back({.noise = noise.entry});
  return reading;
}

std::vector<NamedText> write(const RigCalibration& rig) {
  require_rig(rig, "ORB-SLAM3", 2);
  const Lens& lens = lens_of(rig.cameras[0]);
  NamedText file{.file_name = "orbslam3.yaml",
                 .text = "%YAML:1.0\n\nFile.version: \"1.0\"\n" +
                         value_line("", "Camera.type", std::string("\"") + lens.type + "\"", ""),
                 .next_command = "mono_inertial_euroc ORBvoc.txt orbslam3.yaml SEQUENCE TIMES.txt"};
  const Pose T_c1_b = *imu_to_camera(rig, 0);
  file.text += lens_lines("Camera1.", rig.cameras[0], lens);
  if (rig.cameras.size() == 2) {
    if (&lens_of(rig.cameras[1]) != &lens || rig.cameras[1].resolution_px != rig.cameras[0].resolution_px) {
      fail_rig("ORB-SLAM3 wants two cameras of the same lens and resolution");
    }
    file.text += lens_lines("Camera2.", rig.cameras[1], lens);
    const Pose T_c1_c2 =
        rig.cameras[1].T_cn_cnm1 ? rig.cameras[1].T_cn_cnm1->inverse() : T_c1_b * imu_to_camera(rig, 1)->inverse();
    file.text += opencv_matrix("Stereo.T_c1_c2", T_c1_c2, 'f', "camera 2 to camera 1, m");
  }
  file.text += value_line("", "Camera.width", std::to_string(rig.cameras[0].resolution_px[0]), "px");
  file.text += value_line("", "Camera.height", std::to_string(rig.cameras[0].resolution_px[1]), "px");
  file.text += opencv_matrix("IMU.T_b_c1", T_c1_b.inverse(), 'f', "camera 1 to IMU (the body), m");
  if (!rig.imus.empty()) {
    const NamedText noise = noise_file("orbslam3", rig.imus[0].noise);
    file.text += noise.text;
    file.notes = noise.notes;
  }
  const double shift = common_timeshift(rig, file.notes);
  if (shift != 0.0) {
    file.notes.push_back("ORB-SLAM3 knows no time shift: add " + brief(shift) + " s to the stamps of the images");
  }
  note_lost_line_delay(rig, file.notes);
  note_lost_imu_model(rig, file.notes);
  file.notes.push_back(
      "add Camera.fps, Camera.RGB and the settings of ORBextractor and Viewer from a file that ORB-SLAM3 ships");
  return {file};
}

}  // namespace vispline::orbslam3_rig

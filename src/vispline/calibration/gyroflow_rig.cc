#include "vispline/calibration/dialect_text.h"
#include "vispline/calibration/rig_checks.h"
#include "vispline/calibration/rig_dialects.h"
#include "vispline/calibration/rig_text.h"

// Lens profiles of Gyroflow: one camera, its lens and the readout time of its sensor.
// https://docs.gyroflow.xyz, Lens calibration; fields as in its src/core/lens_profile.rs.
namespace vispline::gyroflow_rig {
using namespace dialect;
namespace {

struct Lens {
  const char* name;  ///< `distortion_model` of the profile
  const char* distortion_model;
};

/// Both pinhole; coefficients in the order of OpenCV, which is that of Kalibr.
constexpr Lens kLenses[] = {{"opencv_fisheye", "equidistant"}, {"opencv_standard", "radtan"}};

/// A lens without distortion is one whose coefficients are 0.
CameraCalibration with_coefficients(CameraCalibration camera) {
  if (camera.model == "pinhole" && camera.distortion_model == "none") {
    camera.distortion_model = "radtan";
    camera.distortion.assign(4, 0.0);
  }
  return camera;
}

const Lens& lens_of(const CameraCalibration& camera) {
  for (const Lens& lens : kLenses) {
    if (camera.model == "pinhole" && camera.distortion_model == lens.distortion_model) return lens;
  }
  fail_rig("Gyroflow knows pinhole with equidistant, radtan or none, " + camera.name + " is " + camera.model +
           " with " + camera.distortion_model);
}

std::string line(const char* key, const std::string& value) {
  return std::string("  \"") + key + "\": " + value + ",\n";
}

std::string size_text(const CameraCalibration& camera) {
  return "{\"w\": " + std::to_string(camera.resolution_px[0]) + ", \"h\": " + std::to_string(camera.resolution_px[1]) +
         "}";
}

/// From the first row to the last and one more, ms: Gyroflow spreads it over the height of the frame.
std::string readout_text(const CameraCalibration& camera) {
  if (!camera.line_delay) return "null";
  return yaml_float(*camera.line_delay * camera.resolution_px[1] * 1e3);
}

std::string profile(const CameraCalibration& given) {
  const CameraCalibration camera = with_coefficients(given);
  const Lens& lens = lens_of(camera);
  const auto [fu, fv, pu, pv] = projection_of(camera);
  std::string text = "{\n" + line("name", "\"vispline " + slug(camera.name) + "\"");
  for (const char* key : {"camera_brand", "camera_model", "lens_model", "camera_setting", "note"})
    text += line(key, "\"\"");
  text += line("calibrated_by", "\"vispline\"");
  for (const char* key : {"calib_dimension", "orig_dimension", "output_dimension"})
    text += line(key, size_text(camera));
  text += line("frame_readout_time", readout_text(camera));
  text += line("global_shutter", camera.line_delay && *camera.line_delay == 0.0 ? "true" : "false");
  text += line("input_horizontal_stretch", "1.0") + line("input_vertical_stretch", "1.0");
  text += line("distortion_model", std::string("\"") + lens.name + "\"");
  text += line("use_opencv_fisheye", lens.name == std::string("opencv_fisheye") ? "true" : "false");
  text += "  \"fisheye_params\": {\n    \"RMS_error\": 0.0,\n    \"camera_matrix\": [\n      " + list({fu, 0.0, pu}) +
          ",\n      " + list({0.0, fv, pv}) + ",\n      " + list({0.0, 0.0, 1.0}) +
          "\n    ],\n    \"distortion_coeffs\": " + list(camera.distortion) + "\n  },\n";
  return text + line("official", "false") + "  \"calibrator_version\": \"vispline\"\n}\n";
}

std::vector<std::string> lost(const RigCalibration& rig, const CameraCalibration& camera) {
  std::vector<std::string> notes;
  if (!camera.line_delay) notes.push_back(camera.name + " has no line delay: frame_readout_time is null");
  if (camera.T_cam_imu || camera.T_cn_cnm1) notes.push_back("the place of " + camera.name + " is lost");
  if (!camera.topic.empty()) notes.push_back("the topic of " + camera.name + " is lost");
  if (camera.timeshift_cam_imu.value_or(0.0) != 0.0) {
    notes.push_back("the time shift of " + camera.name + ", " + brief(*camera.timeshift_cam_imu) +
                    " s, is lost: enter it as an offset in Gyroflow, or shift the stamps");
  }
  if (!rig.imus.empty()) notes.push_back("the IMU is lost");
  return notes;
}

double milliseconds_to_line_delay(double readout_ms, const CameraCalibration& camera) {
  return readout_ms * 1e-3 / camera.resolution_px[1];
}

}  // namespace

bool recognizes(const YamlFile& file) { return file.root.find("fisheye_params") != nullptr; }

RigReading read(const RigInput& input) {
  RigReading reading;
  ConfigMap root(input.file, input.file.root, "", reading.diagnostics);
  CameraCalibration camera;
  const std::string model = root.text_or("distortion_model", "opencv_fisheye");
  for (const Lens& lens : kLenses) {
    if (model == lens.name) camera.distortion_model = lens.distortion_model;
  }
  if (camera.distortion_model == "none") root.fail("distortion_model", "is " + quoted(model) + ", which is not known");
  ConfigMap lens = root.map("fisheye_params");
  const std::vector<double> K = lens.matrix("camera_matrix", 3, 3, "px");
  camera.intrinsics = {K[0], K[4], K[2], K[5]};
  camera.distortion = lens.numbers("distortion_coeffs", 4, "");
  ConfigMap size = root.map("calib_dimension");
  camera.resolution_px = {size.integer("w", "px", 1, 65535), size.integer("h", "px", 1, 65535)};
  const YamlNode* readout = root.node().find("frame_readout_time");
  if (readout && readout->kind == YamlNode::Kind::kScalar && readout->text != "null") {
    camera.line_delay = milliseconds_to_line_delay(root.number("frame_readout_time", "ms"), camera);
  }
  rig_checks::require_possible(lens, "camera_matrix", camera);
  reading.rig.cameras.push_back(camera);
  return reading;
}

std::vector<NamedText> write(const RigCalibration& rig) {
  if (rig.cameras.empty()) fail_rig("Gyroflow takes a camera, the rig has none");
  std::vector<NamedText> files;
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    const std::string name = i == 0 ? "lens_profile.json" : "lens_profile_cam" + std::to_string(i) + ".json";
    files.push_back({.file_name = name,
                     .text = profile(rig.cameras[i]),
                     .next_command = "gyroflow VIDEO.mp4 lens_profile.json RECORDING.gcsv",
                     .notes = lost(rig, rig.cameras[i])});
  }
  return files;
}

}  // namespace vispline::gyroflow_rig

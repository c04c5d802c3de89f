#include "info_calibration.h"

#include <filesystem>
#include <fstream>
#include <iostream>

#include "vispline/calibration/target_file.h"
#include "vispline/calibration/yaml.h"
#include "vispline/io/rig_source.h"
#include "vispline/results/table.h"

namespace vispline::cli {
namespace {

/// One thing that the file holds: a camera, an IMU, a board.
struct Part {
  std::string kind, name, text;
  std::optional<double> readout_s{};
};

std::string numbers(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + number_text(value, 8);
  return "(" + text + ")";
}

Part part_of(const CameraCalibration& camera) {
  std::string text = camera.model + " " + numbers(camera.intrinsics) + ", " + camera.distortion_model + " " +
                     numbers(camera.distortion) + ", " + std::to_string(camera.resolution_px[0]) + " x " +
                     std::to_string(camera.resolution_px[1]) + " px";
  if (camera.T_cam_imu) text += ", T_cam_imu (IMU -> camera)";
  if (camera.timeshift_cam_imu) text += ", timeshift_cam_imu " + number_text(*camera.timeshift_cam_imu, 8) + " s";
  if (!camera.line_delay) return {"camera", camera.name, text};
  const double readout_s = *camera.line_delay * camera.resolution_px[1];
  text += ", line delay " + number_text(*camera.line_delay, 8) + " s, readout time " + number_text(readout_s, 8) + " s";
  return {"camera", camera.name, text, readout_s};
}

std::string walk_text(const WalkEntry& walk) {
  if (walk.value) return number_text(*walk.value, 6);
  return walk.upper_bound ? "below " + number_text(*walk.upper_bound, 6) : "none";
}

Part part_of(const ImuCalibration& imu) {
  const ImuNoiseEntry& noise = imu.noise;
  return {"imu", noise.name,
          "gyro N " + number_text(noise.gyro_white, 6) + " rad/s/sqrt(Hz), K " + walk_text(noise.gyro_walk) +
              " rad/s^2/sqrt(Hz); accel N " + number_text(noise.accel_white, 6) + " m/s^2/sqrt(Hz), K " +
              walk_text(noise.accel_walk) + " m/s^3/sqrt(Hz); " + number_text(noise.rate_hz, 6) + " Hz" +
              (is_ideal(imu) ? "" : "; scale and misalignment")};
}

Part part_of(const TargetCalibration& target) {
  const std::string size = std::to_string(target.cols) + " x " + std::to_string(target.rows);
  if (target.kind == TargetKind::kAprilgrid) {
    return {"target", "aprilgrid",
            size + " tags of " + number_text(target.tag_size_m, 6) + " m, spacing " +
                number_text(target.tag_spacing, 6) + " of a tag"};
  }
  const bool chess = target.kind == TargetKind::kCheckerboard;
  return {"target", chess ? "checkerboard" : "circlegrid",
          size + (chess ? " inner corners" : " circles") + ", " + number_text(target.col_spacing_m, 6) + " m by " +
              number_text(target.row_spacing_m, 6) + " m"};
}

bool is_target(const std::string& path) {
  const YamlFile file = read_yaml(path);
  return file.root.find("target_type") != nullptr || file.root.find("tagCols") != nullptr;
}

}  // namespace

bool is_calibration(const std::string& path) {
  const std::filesystem::path suffix = std::filesystem::path(path).extension();
  if (suffix == ".yaml" || suffix == ".yml" || suffix == ".json") return true;
  std::error_code error;
  const bool recording = std::filesystem::exists(path + "/mav0", error);
  if (!recording && std::filesystem::is_regular_file(path + "/result.json", error)) return true;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  std::string head(6, '\0');
  std::ifstream(path, std::ios::binary).read(head.data(), 6);
  return head == "%YAML:";
}

void print_calibration(const std::string& named, std::optional<double> rate_hz, Session& session) {
  const std::string path = calibration_file_of(named);
  std::vector<Part> parts;
  std::string dialect = "target";
  if (is_target(path)) {
    TargetReading reading = read_target_file(path);
    session.add(reading.diagnostics);
    parts.push_back(part_of(reading.target));
  } else {
    const CalibrationSource source = read_rig_source(path, "", {.rate_hz = rate_hz});
    session.add(source.reading.diagnostics);
    dialect = source.reading.dialect;
    for (const CameraCalibration& camera : source.reading.rig.cameras) parts.push_back(part_of(camera));
    for (const ImuCalibration& imu : source.reading.rig.imus) parts.push_back(part_of(imu));
  }
  session.finish();
  if (!session.json) {
    std::cout << "calibration file of " << dialect << "\n";
    for (const Part& part : parts)
      std::cout << part.kind << " " << vispline::quoted(part.name) << ": " << part.text << "\n";
    return;
  }
  std::vector<JsonObject> objects;
  for (const Part& part : parts) {
    objects.push_back(JsonObject().set("kind", part.kind).set("part", part.name).set("text", part.text));
    objects.back().set("readout_s", part.readout_s);
  }
  JsonObject document = begin_document("vispline.info_calibration/1", session.context);
  document.set("dialect", dialect).set("parts", objects);
  end_document(document, session.context);
  std::cout << document.text();
}

}  // namespace vispline::cli

#include "vispline/calibration/calibration_source.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "vispline/calibration/read_noise.h"

namespace vispline {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kResultSuffix = "-camchain-imucam.yaml";
constexpr std::string_view kRejectedSuffix = ".rejected.yaml";

[[noreturn]] void fail_folder(const std::string& folder, const std::string& found) {
  throw Error(ExitCode::kInput, {.code = "E-OPEN",
                                 .message = found,
                                 .where = folder,
                                 .effect = "nothing written",
                                 .next = "give the calibration file itself"});
}

/// What calibrate and estimate leave in place of a rig that is not to be trusted.
[[noreturn]] void fail_rejected(const std::string& folder, const std::string& file) {
  throw Error(ExitCode::kUntrusted,
              {.code = "E-REJECTED",
               .message = "the result in the folder is not to be trusted, and has no rig.yaml",
               .where = folder,
               .effect = "nothing written",
               .next = "its report says what to record or to fix; the last numbers are in " + file});
}

/// rig.yaml, or the only file that ends as results of Kalibr do.
std::string camera_file_in(const fs::path& folder) {
  if (fs::is_regular_file(folder / "rig.yaml")) return (folder / "rig.yaml").string();
  std::vector<std::string> found;
  std::string rejected;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().string();
    if (name.ends_with(kResultSuffix)) found.push_back(name);
    if (name.ends_with(kRejectedSuffix)) rejected = name;
  }
  if (error) fail_folder(folder.string(), "the folder cannot be read: " + error.message());
  if (found.size() == 1) return found.front();
  if (found.empty() && !rejected.empty()) fail_rejected(folder.string(), rejected);
  fail_folder(folder.string(), "the folder holds no rig.yaml and " + std::to_string(found.size()) + " files *" +
                                   std::string(kResultSuffix));
}

/// The file of the IMU that is written along with `camera_file`; empty if there is none.
std::string imu_file_beside(const std::string& camera_file) {
  constexpr std::pair<std::string_view, std::string_view> kNames[] = {
      {kResultSuffix, "-imu.yaml"},
      {"-camchain.yaml", "-imu.yaml"},
      {"kalibr_imucam_chain.yaml", "kalibr_imu_chain.yaml"},
      {"camchain.yaml", "imu-chain.yaml"}};
  for (const auto& [cameras, imu] : kNames) {
    if (!camera_file.ends_with(cameras)) continue;
    const std::string name = camera_file.substr(0, camera_file.size() - cameras.size()) + std::string(imu);
    if (fs::is_regular_file(name)) return name;
  }
  return "";
}

/// As a rig; a file of imu_utils only says how noisy an IMU is.
RigReading read_any(const std::string& path, const RigReadOptions& options) {
  if (read_yaml(path).root.find("Gyr") == nullptr) return read_rig_file(path, options);
  NoiseReading noise = read_noise_file(path, {.rate_hz = options.rate_hz});
  RigReading reading{.dialect = noise.dialect, .rig = {}, .diagnostics = std::move(noise.diagnostics)};
  reading.rig.imus.push_back({.noise = noise.entry});
  return reading;
}

}  // namespace

std::string calibration_file_of(const std::string& path) {
  if (fs::is_directory(path)) return camera_file_in(path);
  const fs::path file(path);
  if (file.filename() != "result.json") return path;
  if (!fs::is_regular_file(file)) fail_folder(path, "there is no such file");
  return camera_file_in(file.has_parent_path() ? file.parent_path() : ".");
}

CalibrationSource read_calibration(const std::string& path, const std::string& imu_path,
                                   const RigReadOptions& options) {
  CalibrationSource source;
  source.paths.push_back(calibration_file_of(path));
  source.reading = read_any(source.paths[0], options);
  std::string imu = imu_path;
  if (imu.empty() && source.reading.rig.imus.empty()) imu = imu_file_beside(source.paths[0]);
  if (imu.empty()) return source;
  RigReading reading = read_any(imu, options);
  source.paths.push_back(imu);
  source.reading.rig.imus = std::move(reading.rig.imus);
  source.reading.diagnostics.merge(reading.diagnostics);
  return source;
}

std::vector<std::string> bake_timeshift(RigCalibration& rig) {
  std::vector<std::string> sentences;
  for (CameraCalibration& camera : rig.cameras) {
    const double shift = camera.timeshift_cam_imu.value_or(0.0);
    camera.timeshift_cam_imu = 0.0;
    if (shift == 0.0) continue;
    sentences.push_back("add " + std::to_string(std::llround(shift * 1e9)) + " ns to every stamp of the images of " +
                        camera.name + " before they are used: its time shift is written as 0");
  }
  return sentences;
}

}  // namespace vispline

#include "vispline/io/rig_file.h"

#include "vispline/calibration/rig_files.h"
#include "vispline/calibration/yaml_error.h"
#include "vispline/files/small_file.h"
#include "vispline/io/rig_convert.h"
#include "vispline/io/rig_yaml.h"

namespace vispline {
namespace {

void take(std::vector<CameraCalibration>& all, std::vector<CameraCalibration>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

/// What files of other tools hold, together: cameras of one need the IMU of another.
struct Collected {
  RigCalibration calibration{};
  std::string where{};
};

void take_dialect(const std::string& path, const RigFileOptions& options, ReadRig& result, Collected& collected) {
  RigReading reading = read_rig_file(path, {.rate_hz = options.imu_rate_hz});
  result.formats.push_back(reading.dialect);
  result.diagnostics.merge(reading.diagnostics);
  take(collected.calibration.cameras, reading.rig.cameras);
  for (ImuCalibration& imu : reading.rig.imus) {
    // Tg of OpenVINS acts on the specific force in the frame of the IMU, here it is in that of the gyroscope.
    if (reading.dialect == "openvins") imu.gyro_A = Matrix3d(imu.gyro_A * imu.R_gyro_imu.transpose());
    collected.calibration.imus.push_back(imu);
  }
  collected.where += (collected.where.empty() ? "" : ", ") + path;
}

void append(Rig& rig, const Rig& more) {
  rig.imus.insert(rig.imus.end(), more.imus.begin(), more.imus.end());
  rig.cameras.insert(rig.cameras.end(), more.cameras.begin(), more.cameras.end());
}

void take_own(const YamlFile& file, ReadRig& result) {
  RigDocument document = rig_yaml::read(file, result.diagnostics);
  result.formats.emplace_back(rig_yaml::kName);
  result.g_w = document.g_w;
  result.estimate.merge(document.estimate);
  result.clocks.merge(document.clocks);
  append(result.rig, document.rig);
}

}  // namespace

ReadRig read_rig(const std::vector<std::string>& paths, const RigFileOptions& options) {
  require(!paths.empty(), "the name of a rig file");
  ReadRig result;
  Collected collected;
  for (const std::string& path : paths) {
    const YamlFile file = parse_yaml(path, read_small_text_file(path, yaml_limits::kBytes));
    if (rig_yaml::recognizes(file)) {
      take_own(file, result);
    } else {
      take_dialect(path, options, result, collected);
    }
  }
  append(result.rig, rig_of(collected.calibration, collected.where, result.diagnostics));
  require_valid(result.rig);
  return result;
}

void write_rig(const std::string& path, const RigDocument& document, OutputOptions options) {
  require_valid(document.rig);
  write_file(path, rig_yaml::text(document), options);
}

}  // namespace vispline

/// One line per dialect of rig_files.h; each is one .cc file.
#pragma once

#include "vispline/calibration/config_map.h"
#include "vispline/calibration/rig_files.h"

namespace vispline {

struct RigInput {
  const YamlFile& file;
  const SiblingText& sibling;
  const RigReadOptions& options;
};

[[noreturn]] void fail_rig(const std::string& message, const std::string& next = "");  ///< E-CONFIG of a writer
/// E-CONFIG unless the rig has from 1 to `cameras` cameras with a known place relative to the IMU, and at most one IMU.
void require_rig(const RigCalibration& rig, const std::string& tool, std::size_t cameras);
/// timeshift of camera 0; a note if others differ from it.
double common_timeshift(const RigCalibration& rig, std::vector<std::string>& notes);
/// Notes on what only Kalibr's files hold.
void note_lost_line_delay(const RigCalibration& rig, std::vector<std::string>& notes);
/// Notes on what a tool does not model of its only IMU: scale, misalignment, its place in the body.
void note_lost_imu_model(const RigCalibration& rig, std::vector<std::string>& notes);

namespace kalibr_rig {
inline constexpr const char* kName = "kalibr";
bool recognizes(const YamlFile& file);
RigReading read(const RigInput& input);
std::vector<NamedText> write(const RigCalibration& rig);
/// The block of one camera, keys indented by two.
std::string camera_block(const CameraCalibration& camera);
CameraCalibration read_camera(ConfigMap map, const std::string& name);
/// "cam0", "cam1", ...: those that the root holds without a gap.
std::vector<std::string> numbered_keys(const YamlNode& root, const std::string& stem);
}  // namespace kalibr_rig

namespace openvins_rig {
inline constexpr const char* kName = "openvins";
bool recognizes(const YamlFile& file);
RigReading read(const RigInput& input);
std::vector<NamedText> write(const RigCalibration& rig);
/// kalibr_imu_chain.yaml
NamedText imu_chain(const ImuCalibration& imu);
}  // namespace openvins_rig

namespace vins_fusion_rig {
inline constexpr const char* kName = "vins-fusion";
bool recognizes(const YamlFile& file);
RigReading read(const RigInput& input);
std::vector<NamedText> write(const RigCalibration& rig);
}  // namespace vins_fusion_rig

namespace orbslam3_rig {
inline constexpr const char* kName = "orbslam3";
bool recognizes(const YamlFile& file);
RigReading read(const RigInput& input);
std::vector<NamedText> write(const RigCalibration& rig);
}  // namespace orbslam3_rig

namespace basalt_rig {
inline constexpr const char* kName = "basalt";
bool recognizes(const YamlFile& file);
RigReading read(const RigInput& input);
std::vector<NamedText> write(const RigCalibration& rig);
}  // namespace basalt_rig

namespace gyroflow_rig {
inline constexpr const char* kName = "gyroflow";
bool recognizes(const YamlFile& file);
RigReading read(const RigInput& input);
std::vector<NamedText> write(const RigCalibration& rig);
}  // namespace gyroflow_rig

}  // namespace vispline

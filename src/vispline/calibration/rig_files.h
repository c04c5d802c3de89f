/// Cameras and IMUs in the calibration files of other tools. docs/calibration-files.md.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "vispline/calibration/rig_calibration.h"
#include "vispline/calibration/yaml.h"

namespace vispline {

/// "kalibr", "openvins", "vins-fusion", "orbslam3", "basalt", "gyroflow".
std::vector<std::string> rig_dialects();

/// The files of `dialect`. What it cannot hold is in the `notes` of the file. Throws E-CONFIG (exit 2) for an unknown
/// dialect, for a camera that cannot be, and for a lens, a number of cameras or IMUs that the tool does not know.
std::vector<NamedText> rig_files(std::string_view dialect, const RigCalibration& rig);

/// Text of the file `name` beside the one that is read, for dialects that name others.
using SiblingText = std::function<std::string(const std::string& name)>;

struct RigReadOptions {
  std::optional<double> rate_hz{};  ///< of the IMU, for VINS-Fusion, whose file has no rate; without it: no IMU is read
};

/// By content. Throws what parse_yaml throws, E-CONFIG for a value that is missing, of the wrong kind or impossible,
/// E-PATH (exit 3) for a sibling outside the folder. W-CONFIG for unknown keys and rotations that were projected.
RigReading parse_rig(std::string path, std::string_view text, const SiblingText& sibling,
                     const RigReadOptions& options = {});

RigReading read_rig_file(const std::string& path, const RigReadOptions& options = {});

}  // namespace vispline

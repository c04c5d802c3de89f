/// Rigs from files, ours and those of other tools, and to files. docs/formats.md, Rigs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vispline/core/error.h"
#include "vispline/files/output_file.h"
#include "vispline/io/rig_document.h"

namespace vispline {

struct ReadRig {
  Rig rig{};
  Vector3d g_w{0.0, 0.0, -9.81};       ///< m/s^2, points down; of our own files, else this
  ParameterChoices estimate{};         ///< of our own files only
  ClockModels clocks{};                ///< of our own files only
  std::vector<std::string> formats{};  ///< of each file: "vispline", or one of rig_dialects()
  Diagnostics diagnostics{};
};

struct RigFileOptions {
  std::optional<double> imu_rate_hz{};  ///< for VINS-Fusion, whose file has no rate; without it: no IMU is read
};

/// One rig from one file or from several, such as camchain.yaml and imu.yaml; each may be ours or of a dialect of
/// calibration/rig_files.h, found from its content. Files of other tools have no rate of a camera and no pixel noise:
/// these stay as in Camera. Throws what parse_yaml throws, E-CONFIG (exit 2) for an impossible value and for two
/// sensors of one name, E-OPEN (exit 3).
ReadRig read_rig(const std::vector<std::string>& paths, const RigFileOptions& options = {});

/// Our own format; reads back to the same values.
void write_rig(const std::string& path, const RigDocument& document, OutputOptions options = {});

}  // namespace vispline

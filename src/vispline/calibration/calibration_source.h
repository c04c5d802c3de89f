/// A calibration as a command is given it: a file of any dialect, or the folder of a result. docs/calibration-files.md.
#pragma once

#include <string>
#include <vector>

#include "vispline/calibration/rig_files.h"

namespace vispline {

struct CalibrationSource {
  RigReading reading{};
  std::vector<std::string> paths{};  ///< the files that were read, the cameras first
  std::vector<std::string> notes{};  ///< what the values above cannot hold of the file
};

/// The file that `path` stands for: of a folder, or a `result.json` in it, `rig.yaml` or the one
/// `*-camchain-imucam.yaml`; else `path` itself. Throws E-OPEN (exit 3) for a folder without such a file or with
/// several and for a result.json that is absent, E-REJECTED (exit 5) for a result that was not to be trusted.
std::string calibration_file_of(const std::string& path);

/// `path` as for calibration_file_of; a file of one of rig_dialects(). The IMU comes from `imu_path`; without it from
/// the same file, or from the file beside it that tools write along: `NAME-imu.yaml` of `NAME-camchain-imucam.yaml` or
/// of `NAME-camchain.yaml`, `kalibr_imu_chain.yaml` of `kalibr_imucam_chain.yaml`. Throws what read_rig_file and
/// read_noise_file throw, and calibration_file_of.
CalibrationSource read_calibration(const std::string& path, const std::string& imu_path = "",
                                   const RigReadOptions& options = {});

/// Time shifts become zero. One sentence per camera: what must be added to the stamps of its images instead.
std::vector<std::string> bake_timeshift(RigCalibration& rig);

}  // namespace vispline

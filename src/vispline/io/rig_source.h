/// A calibration as a command is given it, of any tool and our own. docs/calibration-files.md.
#pragma once

#include <string>

#include "vispline/calibration/calibration_source.h"

namespace vispline {

/// As read_calibration, and our own rig files too, so that the folder of a result is one. What their cameras and IMUs
/// have beyond other tools' files stands in `notes`. `reading.dialect` is then "vispline".
CalibrationSource read_rig_source(const std::string& path, const std::string& imu_path = "",
                                  const RigReadOptions& options = {});

}  // namespace vispline

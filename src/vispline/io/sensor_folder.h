/// The folders of EuRoC, TUM-VI and Kalibr's bag extractor: one file of measurements for each sensor. docs/formats.md,
/// Folders.
#pragma once

#include <string>
#include <vector>

#include "vispline/io/read_context.h"

namespace vispline {

struct SensorFile {
  std::string name;  ///< of the sensor: "imu0", "state_groundtruth_estimate0"
  std::string path;
};

/// In order of name: NAME/data.csv in `folder`/mav0, or in `folder` itself, and NAME.csv beside them. Empty if there is
/// none. Never throws.
std::vector<SensorFile> sensor_files(const std::string& folder);

/// Which sensors hold a kind of signal, by the beginning of their names.
enum class SensorKind { kImu, kPoses, kAny };

/// The file to read for `path`: itself, or if it is a folder that of the sensor options.topic, or of the only sensor of
/// the kind; of kAny the first IMU. Throws E-TOPIC (exit 4) and E-TOPIC-AMBIGUOUS (exit 2) with the sensors of the
/// folder, E-OPEN (exit 3) for a folder without any, and E-ARGUMENT (exit 2) for a topic of a file that has none.
std::string measurement_file(const std::string& path, const ReadOptions& options, SensorKind kind);

}  // namespace vispline

/// The front of the readers: a text table, a recording of messages (rosbag, MCAP, rosbag2) or a folder of sensors in, a
/// signal and an account of every row out. docs/formats.md.
#pragma once

#include <string>

#include "vispline/core/pose.h"
#include "vispline/core/signal.h"
#include "vispline/io/read_options.h"
#include "vispline/io/read_result.h"
#include "vispline/sensors/recording.h"

namespace vispline {

/// Angular rate and specific force in the frame of the IMU, SI units whatever the file's. Throws Error with the codes
/// of docs/formats.md; counts.read = counts.kept + counts.dropped_total() always.
ReadResult<ImuSignal> read_imu(const std::string& path, const ReadOptions& options = {});

/// Poses T_w_b. Rows whose pose is nan are gaps (W-NONFINITE) unless they are more than half of all (E-NONFINITE).
ReadResult<Signal<Pose>> read_trajectory(const std::string& path, const ReadOptions& options = {});

/// What the columns of a file hold.
enum class ContentKind { kImu, kTrajectory, kBoth };

/// From the first rows, or the topics, only. Throws as the readers do if the file cannot be read or its columns mean
/// neither.
ContentKind content_of(const std::string& path, const ReadOptions& options = {});

}  // namespace vispline

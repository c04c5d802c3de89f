/// IMU samples of a recording of messages: one topic of sensor_msgs/Imu, or two of which one holds the gyroscope and
/// the other the accelerometer. docs/formats.md, Recordings.
#pragma once

#include <string>

#include "vispline/io/imu_stream.h"

namespace vispline {

/// As stream_imu, for a rosbag, an MCAP file, a .db3 file or the folder of a rosbag2. At most one decompressed chunk
/// and some windows of rows are held. Throws also as BagReader and choose_topic do.
ImuStreamResult stream_imu_bag(const std::string& path, const ReadOptions& options, const ImuSink& sink,
                               const ImuStreamSettings& settings);

}  // namespace vispline

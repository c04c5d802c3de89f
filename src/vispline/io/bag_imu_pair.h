/// A gyroscope and an accelerometer on two topics of one recording. docs/formats.md, Recordings.
#pragma once

#include <string>

#include "vispline/io/imu_stream.h"

namespace vispline {

/// As stream_imu_bag, from options.gyro_topic and options.accel_topic, put together by TriadStream. Counted are the
/// messages of the gyroscope; samples that have no accelerometer within 0.1 s on both sides are dropped (W-UNPAIRED).
ImuStreamResult stream_imu_pair(const std::string& path, const ReadOptions& options, const ImuSink& sink,
                                const ImuStreamSettings& settings);

}  // namespace vispline

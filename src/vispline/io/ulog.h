/// The IMU of a PX4 log. docs/formats.md, Autopilots.
#pragma once

#include <string_view>

#include "vispline/bags/input.h"
#include "vispline/io/imu_stream.h"

namespace vispline::ulog {

inline constexpr std::string_view kName = "ulog";

bool recognizes(Bytes head);

/// From `sensor_combined`, else `vehicle_imu` (increments over their interval), else `sensor_gyro` with `sensor_accel`;
/// of several instances the first. In the axes of the log: forward, right, down. Stamps are those of the log.
ImuStreamResult stream(const Input& input, const ReadOptions& options, const ImuSink& sink,
                       const ImuStreamSettings& settings);

}  // namespace vispline::ulog

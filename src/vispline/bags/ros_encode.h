/// Plain structs -> messages of ROS 1 and ROS 2, the inverse of ros_messages.h.
#pragma once

#include <string>
#include <string_view>

#include "vispline/bags/ros_messages.h"

namespace vispline::ros {

/// The bytes of a message; `wire` is kRos1 or kCdr (little-endian). Stamps are from 0 and end in 2106 (ROS 1) or 2038
/// (CDR): `stamp_fits` tells. For Imu, PoseStamped, PoseWithCovarianceStamped, TransformStamped, PointStamped,
/// Odometry, Image and CompressedImage.
template <class T>
void encode(const T& message, Wire wire, std::string& out);

bool stamp_fits(std::int64_t stamp_ns, Wire wire);

/// A topic of messages of `type` ("sensor_msgs/Imu"), with the name, md5 and definition that the wire asks for. Only
/// for the types of encode().
Topic make_topic(std::string name, std::string_view type, Wire wire);

/// The bytes of a message of `type` in another wire; empty if it cannot be decoded or is of no type of encode().
bool transcode(std::string_view type, Bytes data, Wire from, Wire to, std::string& out);
bool can_transcode(std::string_view type);

}  // namespace vispline::ros

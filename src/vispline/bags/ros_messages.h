/// Messages of ROS 1 and ROS 2 that a visual-inertial recording holds, as plain structs. Views point into the message.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "vispline/bags/ros_fields.h"

namespace vispline::ros {

struct Header {
  std::int64_t stamp_ns = 0;  ///< seconds * 1e9 + nanoseconds, as they stand
  bool stamp_valid = true;    ///< seconds from 0, nanoseconds below 1e9
  std::string_view frame_id;
};
struct Vector3 {
  double x = 0, y = 0, z = 0;
};
struct Quaternion {
  double x = 0, y = 0, z = 0, w = 1;
};
struct Pose {
  Vector3 position;  ///< m
  Quaternion orientation;
};
struct Imu {
  Header header;
  Quaternion orientation;
  double orientation_covariance[9] = {};  ///< first number -1: there is no orientation
  Vector3 angular_velocity;               ///< rad/s
  double angular_velocity_covariance[9] = {};
  Vector3 linear_acceleration;  ///< specific force, m/s^2
  double linear_acceleration_covariance[9] = {};
};
struct PoseStamped {
  Header header;
  Pose pose;
};
struct PoseWithCovarianceStamped {
  Header header;
  Pose pose;
  double covariance[36] = {};
};
struct TransformStamped {
  Header header;
  std::string_view child_frame_id;
  Pose transform;  ///< child to header.frame_id
};
struct PointStamped {
  Header header;
  Vector3 point;
};
struct Odometry {
  Header header;
  std::string_view child_frame_id;
  Pose pose;
  double pose_covariance[36] = {};
  Vector3 linear, angular;  ///< in child_frame_id
  double twist_covariance[36] = {};
};
struct Image {
  Header header;
  std::uint32_t height = 0, width = 0;
  std::string_view encoding;
  bool big_endian = false;
  std::uint32_t step = 0;  ///< bytes of a row
  Bytes pixels;
};
struct CompressedImage {
  Header header;
  std::string_view format;
  Bytes bytes;
};
/// Without the calibration.
struct CameraInfo {
  Header header;
  std::uint32_t height = 0, width = 0;
  std::string_view distortion_model;
};

/// Absent if the message is short, has an impossible length, or goes on behind its last field (up to 3 bytes of padding
/// in CDR may follow).
template <class T>
std::optional<T> decode(Bytes data, Wire wire);

/// "sensor_msgs/Imu" of "sensor_msgs/msg/Imu"; any other name unchanged.
std::string plain_type(std::string_view type);

/// Whether messages of `topic` can be decoded as `type` ("sensor_msgs/Imu"), and whether that is sure.
enum class Match {
  kOtherType,
  kOtherDefinition,  ///< the name is the same, the md5 is not: decoding it would be a guess
  kSame,
};
Match match(const Topic& topic, std::string_view type);

}  // namespace vispline::ros

#include "vispline/bags/ros_definitions.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace vispline::ros {
namespace {

struct Definition {
  std::string_view type;
  std::string_view md5;     ///< of the types that a topic can have
  std::string_view fields;  ///< types that are not built in carry their package
};

constexpr std::array kDefinitions = {
    Definition{"sensor_msgs/Imu", "6a62c6daae103f4ff57a132d6f95cec2",
               "std_msgs/Header header\ngeometry_msgs/Quaternion orientation\nfloat64[9] orientation_covariance\n"
               "geometry_msgs/Vector3 angular_velocity\nfloat64[9] angular_velocity_covariance\n"
               "geometry_msgs/Vector3 linear_acceleration\nfloat64[9] linear_acceleration_covariance\n"},
    Definition{"sensor_msgs/Image", "060021388200f6f0f447d0fcd9c64743",
               "std_msgs/Header header\nuint32 height\nuint32 width\nstring encoding\nuint8 is_bigendian\nuint32 step\n"
               "uint8[] data\n"},
    Definition{"sensor_msgs/CompressedImage", "8f7a12909da2c9d3332d540a0977563f",
               "std_msgs/Header header\nstring format\nuint8[] data\n"},
    // Read in part only, so there is nothing to write.
    Definition{"sensor_msgs/CameraInfo", "c9a58c1b0b154e0e6da7578cb991d214", ""},
    Definition{"geometry_msgs/PoseStamped", "d3812c3cbc69362b77dc0b19b345f8f5",
               "std_msgs/Header header\ngeometry_msgs/Pose pose\n"},
    Definition{"geometry_msgs/PoseWithCovarianceStamped", "953b798c0f514ff060a53a3498ce6246",
               "std_msgs/Header header\ngeometry_msgs/PoseWithCovariance pose\n"},
    Definition{"geometry_msgs/TransformStamped", "b5764a33bfeb3588febc2682852579b0",
               "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n"},
    Definition{"geometry_msgs/PointStamped", "c63aecb41bfdfd6b7e1fac37c7cbe7bf",
               "std_msgs/Header header\ngeometry_msgs/Point point\n"},
    Definition{"nav_msgs/Odometry", "cd5e73d190d741a2f92e81eda573aca7",
               "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance pose\n"
               "geometry_msgs/TwistWithCovariance twist\n"},
    Definition{"geometry_msgs/PoseWithCovariance", "", "geometry_msgs/Pose pose\nfloat64[36] covariance\n"},
    Definition{"geometry_msgs/TwistWithCovariance", "", "geometry_msgs/Twist twist\nfloat64[36] covariance\n"},
    Definition{"geometry_msgs/Twist", "", "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n"},
    Definition{"geometry_msgs/Transform", "", "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n"},
    Definition{"geometry_msgs/Pose", "", "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n"},
    Definition{"geometry_msgs/Point", "", "float64 x\nfloat64 y\nfloat64 z\n"},
    Definition{"geometry_msgs/Vector3", "", "float64 x\nfloat64 y\nfloat64 z\n"},
    Definition{"geometry_msgs/Quaternion", "", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n"},
};

constexpr std::array kRos1Header = {
    Definition{"std_msgs/Header", "", "uint32 seq\ntime stamp\nstring frame_id\n"},
};
constexpr std::array kRos2Header = {
    Definition{"std_msgs/Header", "", "builtin_interfaces/Time stamp\nstring frame_id\n"},
    Definition{"builtin_interfaces/Time", "", "int32 sec\nuint32 nanosec\n"},
};

template <std::size_t n>
const Definition* find_in(const std::array<Definition, n>& table, std::string_view type) {
  const auto found = std::ranges::find(table, type, &Definition::type);
  return found == table.end() ? nullptr : &*found;
}

const Definition* find(std::string_view type, Wire wire) {
  if (const Definition* common = find_in(kDefinitions, type)) return common;
  return wire == Wire::kCdr ? find_in(kRos2Header, type) : find_in(kRos1Header, type);
}

/// The types of the fields, in their order.
std::vector<std::string_view> types_in(std::string_view fields) {
  std::vector<std::string_view> types;
  while (!fields.empty()) {
    types.push_back(fields.substr(0, fields.find_first_of(" [")));
    fields.remove_prefix(std::min(fields.size(), fields.find('\n') + 1));
  }
  return types;
}

}  // namespace

std::string definition_of(std::string_view type, Wire wire) {
  const Definition* main = find(type, wire);
  if (main == nullptr || main->fields.empty()) return "";
  std::string text(main->fields);
  std::vector<std::string_view> parts = types_in(main->fields), done;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Definition* part = find(parts[i], wire);
    if (part == nullptr || std::ranges::find(done, parts[i]) != done.end()) continue;
    done.push_back(parts[i]);
    text += "\n" + std::string(80, '=') + "\nMSG: " + std::string(part->type) + "\n" + std::string(part->fields);
    for (const std::string_view deeper : types_in(part->fields)) parts.push_back(deeper);
  }
  return text;
}

std::string known_md5(std::string_view type) {
  const Definition* known = find_in(kDefinitions, type);
  return known == nullptr ? "" : std::string(known->md5);
}

}  // namespace vispline::ros

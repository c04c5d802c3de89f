/// Which topic of a recording a reader takes: the one named by a flag, or the only one that fits. docs/formats.md,
/// Recordings.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vispline/bags/bag.h"
#include "vispline/io/read_context.h"

namespace vispline {

/// The messages that hold IMU samples, and those that hold poses, in the names of ROS 1.
inline constexpr std::array<std::string_view, 1> kImuTypes = {"sensor_msgs/Imu"};
inline constexpr std::array<std::string_view, 4> kPoseTypes = {"geometry_msgs/PoseStamped",
                                                               "geometry_msgs/PoseWithCovarianceStamped",
                                                               "geometry_msgs/TransformStamped", "nav_msgs/Odometry"};

struct TopicChoice {
  std::string name;
  std::string type;          ///< in the names of ROS 1
  std::vector<bool> wanted;  ///< for each of the reader's topics: one name may stand for several connections
};

/// A topic of one of `types`: `name`, or if that is empty the only one with messages. `flag` is what names it. Throws
/// E-TOPIC (exit 4) with all topics, the nearest name first; E-TOPIC-AMBIGUOUS (exit 2); E-TYPE for a topic of another
/// type or two types (exit 4), and for one whose definition is not the known one (exit 3): decoding it would be a
/// guess; E-UNSUPPORTED (exit 3) for another encoding.
TopicChoice choose_topic(const ReadContext& context, const std::vector<Topic>& topics, const std::string& name,
                         std::string_view flag, std::span<const std::string_view> types);

/// "'/imu' (sensor_msgs/Imu, 4839 messages), ...", at most twenty, those first whose names are nearest to `name`.
std::string topic_list(const std::vector<Topic>& topics, const std::string& name = "");

/// Does any topic of these types have messages, or might it?
bool has_topic_of(const std::vector<Topic>& topics, std::span<const std::string_view> types);

}  // namespace vispline

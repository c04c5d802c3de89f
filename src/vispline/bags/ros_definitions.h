/// The text of the message definitions that a recording of ours carries: fields only, as the packages of ROS publish
/// them (common_msgs, common_interfaces).
#pragma once

#include <string>
#include <string_view>

#include "vispline/bags/bag.h"

namespace vispline::ros {

/// Of `type` ("sensor_msgs/Imu") and of all it is made of, each after a line of 80 `=` and `MSG: package/Type`, as
/// rosbag and MCAP want it. Empty for a type that is not known.
std::string definition_of(std::string_view type, Wire wire);

/// Of the ROS 1 definition, 32 digits; empty for a type that is not known.
std::string known_md5(std::string_view type);

}  // namespace vispline::ros

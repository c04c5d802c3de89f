#include "vispline/bags/ros_encode.h"

#include <gtest/gtest.h>

namespace vispline {
namespace {

ros::Odometry odometry() {
  ros::Odometry message;
  message.header = {.stamp_ns = 1'600'000'000'123'456'789, .frame_id = "world"};
  message.child_frame_id = "body7";
  message.pose = {{1, 2, 3}, {0.1, 0.2, 0.3, 0.9}};
  for (int i = 0; i < 36; ++i) message.pose_covariance[i] = i, message.twist_covariance[i] = -i;
  message.linear = {4, 5, 6};
  message.angular = {7, 8, 9};
  return message;
}

TEST(RosEncode, IsTheInverseOfDecode) {
  for (const Wire wire : {Wire::kRos1, Wire::kCdr}) {
    std::string bytes;
    ros::encode(odometry(), wire, bytes);
    const auto back = ros::decode<ros::Odometry>(as_bytes(bytes), wire);
    ASSERT_TRUE(back);
    EXPECT_EQ(back->header.stamp_ns, odometry().header.stamp_ns);
    EXPECT_EQ(back->header.frame_id, "world");
    EXPECT_EQ(back->child_frame_id, "body7");
    EXPECT_EQ(back->pose.orientation.w, 0.9);
    EXPECT_EQ(back->pose_covariance[35], 35);
    EXPECT_EQ(back->angular.z, 9);
    EXPECT_EQ(back->twist_covariance[35], -35);
  }
}

TEST(RosEncode, FromOneWireToTheOtherAndBack) {
  std::string first, there, back;
  ros::encode(odometry(), Wire::kRos1, first);
  ASSERT_TRUE(ros::transcode("nav_msgs/Odometry", as_bytes(first), Wire::kRos1, Wire::kCdr, there));
  ASSERT_TRUE(ros::transcode("nav_msgs/msg/Odometry", as_bytes(there), Wire::kCdr, Wire::kRos1, back));
  EXPECT_EQ(back, first);
  EXPECT_FALSE(ros::transcode("std_msgs/String", as_bytes(first), Wire::kRos1, Wire::kCdr, there));
  EXPECT_FALSE(ros::transcode("sensor_msgs/Imu", as_bytes(first), Wire::kRos1, Wire::kCdr, there));
}

TEST(RosEncode, StampsOfEitherRos) {
  EXPECT_TRUE(ros::stamp_fits(0, Wire::kCdr));
  EXPECT_FALSE(ros::stamp_fits(-1, Wire::kRos1));
  EXPECT_TRUE(ros::stamp_fits(2'200'000'000'000'000'000, Wire::kRos1));
  EXPECT_FALSE(ros::stamp_fits(2'200'000'000'000'000'000, Wire::kCdr));
  EXPECT_FALSE(ros::stamp_fits(4'400'000'000'000'000'000, Wire::kRos1));
}

TEST(RosEncode, TopicsCarryTheirDefinition) {
  const Topic one = ros::make_topic("/imu", "sensor_msgs/Imu", Wire::kRos1);
  EXPECT_EQ(one.md5, "6a62c6daae103f4ff57a132d6f95cec2");
  EXPECT_NE(one.definition.find("MSG: std_msgs/Header\nuint32 seq"), std::string::npos);
  const Topic two = ros::make_topic("/imu", "sensor_msgs/Imu", Wire::kCdr);
  EXPECT_EQ(two.type, "sensor_msgs/msg/Imu");
  EXPECT_NE(two.definition.find("MSG: builtin_interfaces/Time"), std::string::npos);
  EXPECT_EQ(two.definition.find("seq"), std::string::npos);
}

}  // namespace
}  // namespace vispline

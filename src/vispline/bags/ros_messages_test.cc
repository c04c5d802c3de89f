#include "vispline/bags/ros_messages.h"

#include <gtest/gtest.h>

#include <bit>

namespace vispline {
namespace {

/// Bytes of a message as a recorder writes them, by the rules of the wire.
class Wired {
 public:
  explicit Wired(Wire wire, bool big_endian = false) : cdr_(wire == Wire::kCdr), big_(big_endian) {
    if (cdr_) bytes_ = std::string("\0\1\0\0", 4);
    if (big_) bytes_[1] = 0;
  }
  template <std::unsigned_integral T>
  Wired& number(T value) {
    while (cdr_ && (bytes_.size() - 4) % sizeof(T) != 0) bytes_ += '?';  // padding may hold anything
    std::string text;
    store_le(text, value);
    if (big_) std::reverse(text.begin(), text.end());
    bytes_ += text;
    return *this;
  }
  Wired& doubles(int count, double first) {
    for (int i = 0; i < count; ++i) number(std::bit_cast<std::uint64_t>(first + i));
    return *this;
  }
  Wired& text(const std::string& value) {
    number(static_cast<std::uint32_t>(value.size() + (cdr_ ? 1 : 0)));
    bytes_ += value;
    if (cdr_) bytes_ += '\0';
    return *this;
  }
  Wired& header(const std::string& frame) {
    if (!cdr_) number(std::uint32_t{77});
    return number(std::uint32_t{1'600'000'000}).number(std::uint32_t{123'456'789}).text(frame);
  }
  Bytes bytes() const { return as_bytes(bytes_); }
  std::string bytes_;

 private:
  bool cdr_, big_;
};

const Wire kWires[] = {Wire::kRos1, Wire::kCdr};

/// Every shorter message is refused, and so is one with more bytes behind it.
template <class T>
void expect_exact(const Wired& message, Wire wire) {
  for (std::size_t size = 0; size < message.bytes_.size(); ++size) {
    const std::string cut = message.bytes_.substr(0, size);
    EXPECT_FALSE(ros::decode<T>(as_bytes(cut), wire)) << size;
  }
  EXPECT_FALSE(ros::decode<T>(as_bytes(message.bytes_ + "1234"), wire));
  EXPECT_FALSE(ros::decode<T>(message.bytes(), Wire::kOther));
}

TEST(RosMessages, Imu) {
  for (const bool big : {false, true}) {
    for (const Wire wire : kWires) {
      if (big && wire == Wire::kRos1) continue;
      const Wired message = Wired(wire, big).header("imu4").doubles(37, 1);
      const auto imu = ros::decode<ros::Imu>(message.bytes(), wire);
      ASSERT_TRUE(imu);
      EXPECT_EQ(imu->header.stamp_ns, 1'600'000'000'123'456'789);
      EXPECT_TRUE(imu->header.stamp_valid);
      EXPECT_EQ(imu->header.frame_id, "imu4");
      EXPECT_EQ(imu->orientation.x, 1);
      EXPECT_EQ(imu->orientation.w, 4);
      EXPECT_EQ(imu->orientation_covariance[8], 13);
      EXPECT_EQ(imu->angular_velocity.x, 14);
      EXPECT_EQ(imu->angular_velocity_covariance[0], 17);
      EXPECT_EQ(imu->linear_acceleration.z, 28);
      EXPECT_EQ(imu->linear_acceleration_covariance[8], 37);
      expect_exact<ros::Imu>(message, wire);
    }
  }
}

TEST(RosMessages, Poses) {
  for (const Wire wire : kWires) {
    const Wired stamped = Wired(wire).header("map").doubles(7, 1);
    EXPECT_EQ(ros::decode<ros::PoseStamped>(stamped.bytes(), wire)->pose.orientation.w, 7);
    expect_exact<ros::PoseStamped>(stamped, wire);
    const Wired covariance = Wired(wire).header("map").doubles(43, 1);
    EXPECT_EQ(ros::decode<ros::PoseWithCovarianceStamped>(covariance.bytes(), wire)->covariance[35], 43);
    expect_exact<ros::PoseWithCovarianceStamped>(covariance, wire);
    const Wired transform = Wired(wire).header("world").text("tracker").doubles(7, 1);
    const auto decoded = ros::decode<ros::TransformStamped>(transform.bytes(), wire);
    EXPECT_EQ(decoded->child_frame_id, "tracker");
    EXPECT_EQ(decoded->transform.position.z, 3);
    expect_exact<ros::TransformStamped>(transform, wire);
    const Wired point = Wired(wire).header("world").doubles(3, 1);
    EXPECT_EQ(ros::decode<ros::PointStamped>(point.bytes(), wire)->point.y, 2);
    expect_exact<ros::PointStamped>(point, wire);
  }
}

TEST(RosMessages, Odometry) {
  for (const Wire wire : kWires) {
    const Wired message = Wired(wire).header("odom").text("base").doubles(85, 1);
    const auto odometry = ros::decode<ros::Odometry>(message.bytes(), wire);
    ASSERT_TRUE(odometry);
    EXPECT_EQ(odometry->child_frame_id, "base");
    EXPECT_EQ(odometry->pose_covariance[0], 8);
    EXPECT_EQ(odometry->linear.x, 44);
    EXPECT_EQ(odometry->angular.z, 49);
    EXPECT_EQ(odometry->twist_covariance[35], 85);
    expect_exact<ros::Odometry>(message, wire);
  }
}

TEST(RosMessages, Images) {
  for (const Wire wire : kWires) {
    const std::uint32_t height = 2, width = 3, step = 4, size = 8;
    Wired image = Wired(wire).header("cam0").number(height).number(width).text("mono8").number(std::uint8_t{0});
    image.number(step).number(size);
    image.bytes_ += "abcdefgh";
    const auto decoded = ros::decode<ros::Image>(image.bytes(), wire);
    ASSERT_TRUE(decoded);
    EXPECT_EQ(decoded->width, 3u);
    EXPECT_EQ(decoded->height, 2u);
    EXPECT_EQ(decoded->encoding, "mono8");
    EXPECT_EQ(as_text(decoded->pixels), "abcdefgh");
    expect_exact<ros::Image>(image, wire);
    Wired taller = Wired(wire).header("cam0").number(std::uint32_t{3}).number(width).text("mono8");
    taller.number(std::uint8_t{0}).number(step).number(size).bytes_ += "abcdefgh";
    EXPECT_FALSE(ros::decode<ros::Image>(taller.bytes(), wire)) << "12 pixels in 8 bytes";
    Wired compressed = Wired(wire).header("cam0").text("jpeg").number(std::uint32_t{3});
    compressed.bytes_ += "xyz";
    EXPECT_EQ(as_text(ros::decode<ros::CompressedImage>(compressed.bytes(), wire)->bytes), "xyz");
    const Wired info = Wired(wire).header("cam0").number(height).number(width).text("plumb_bob").doubles(9, 1);
    EXPECT_EQ(ros::decode<ros::CameraInfo>(info.bytes(), wire)->distortion_model, "plumb_bob");
  }
}

TEST(RosMessages, ImpossibleContents) {
  const Wired longer = Wired(Wire::kRos1).number(std::uint32_t{0}).number(std::uint64_t{0}).number(UINT32_MAX);
  EXPECT_FALSE(ros::decode<ros::PointStamped>(longer.bytes(), Wire::kRos1));
  Wired no_nul = Wired(Wire::kCdr).header("world").doubles(3, 1);
  no_nul.bytes_[4 + 12 + 5] = 'x';
  EXPECT_FALSE(ros::decode<ros::PointStamped>(no_nul.bytes(), Wire::kCdr));
  Wired xcdr2 = Wired(Wire::kCdr).header("world").doubles(3, 1);
  xcdr2.bytes_[1] = 7;
  EXPECT_FALSE(ros::decode<ros::PointStamped>(xcdr2.bytes(), Wire::kCdr));
  Wired stamp = Wired(Wire::kCdr).number(std::uint32_t{5}).number(std::uint32_t{1'000'000'000}).text("").doubles(3, 1);
  EXPECT_FALSE(ros::decode<ros::PointStamped>(stamp.bytes(), Wire::kCdr)->header.stamp_valid);
  Wired early = Wired(Wire::kCdr).number(UINT32_MAX).number(std::uint32_t{0}).text("").doubles(3, 1);
  EXPECT_EQ(ros::decode<ros::PointStamped>(early.bytes(), Wire::kCdr)->header.stamp_ns, -1'000'000'000);
}

TEST(RosMessages, TypesAndDefinitions) {
  Topic topic{.name = "/imu", .type = "sensor_msgs/Imu", .md5 = "6a62c6daae103f4ff57a132d6f95cec2", .definition = {}};
  EXPECT_EQ(ros::match(topic, "sensor_msgs/Imu"), ros::Match::kSame);
  EXPECT_EQ(ros::match(topic, "sensor_msgs/Image"), ros::Match::kOtherType);
  topic.md5[0] = '7';
  EXPECT_EQ(ros::match(topic, "sensor_msgs/msg/Imu"), ros::Match::kOtherDefinition);
  const Topic ros2{.name = "/imu", .type = "sensor_msgs/msg/Imu", .md5 = {}, .definition = {}, .wire = Wire::kCdr};
  EXPECT_EQ(ros::match(ros2, "sensor_msgs/Imu"), ros::Match::kSame);
}

}  // namespace
}  // namespace vispline

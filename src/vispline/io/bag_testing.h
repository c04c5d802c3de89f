/// Recordings of messages with made-up samples, for the tests of the readers.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "vispline/bags/bag_writer.h"
#include "vispline/bags/ros_encode.h"
#include "vispline/io/io_testing.h"

namespace vispline {

struct Made {
  std::string topic;
  std::string type;
  std::int64_t receive_ns = 0;
  std::string data;
};

inline ros::Vector3 to_ros(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

inline ros::Imu imu_message(Time time, const ImuSample& sample) {
  ros::Imu imu;
  imu.header = {.stamp_ns = to_ns(time), .frame_id = "imu0"};
  imu.angular_velocity = to_ros(sample.gyro);
  imu.linear_acceleration = to_ros(sample.accel);
  return imu;
}

inline ros::Pose pose_message(const Pose& T_w_b) {
  const Eigen::Quaterniond q = T_w_b.quaternion();
  return {to_ros(T_w_b.p), {q.x(), q.y(), q.z(), q.w()}};
}

template <class T>
Made made(const std::string& topic, const std::string& type, Wire wire, std::int64_t receive_ns, const T& message) {
  Made out{topic, type, receive_ns, {}};
  ros::encode(message, wire, out.data);
  return out;
}

/// An Imu topic; messages arrive `delay_ns` after their stamp.
inline std::vector<Made> imu_messages(const ImuSignal& imu, Wire wire, const std::string& topic = "/imu",
                                      std::int64_t delay_ns = 0) {
  std::vector<Made> messages;
  for (std::size_t i = 0; i < imu.size(); ++i) {
    messages.push_back(
        made(topic, "sensor_msgs/Imu", wire, to_ns(imu.time[i]) + delay_ns, imu_message(imu.time[i], imu.value[i])));
  }
  return messages;
}

inline Wire wire_of(Container container) { return container == Container::kRosbag ? Wire::kRos1 : Wire::kCdr; }

inline std::string write_bag(const std::string& path, const std::vector<Made>& messages,
                             Container container = Container::kRosbag, BagWriterOptions options = {}) {
  options.force = true;
  const auto writer = make_bag_writer(container, path, options);
  std::map<std::pair<std::string, std::string>, std::size_t> numbers;
  for (const Made& message : messages) {
    const auto key = std::pair(message.topic, message.type);
    if (!numbers.contains(key)) {
      numbers[key] = writer->add_topic(ros::make_topic(message.topic, message.type, wire_of(container)));
    }
    writer->write(numbers[key], message.receive_ns, as_bytes(message.data));
  }
  writer->publish();
  return path;
}

inline std::vector<Made> operator+(std::vector<Made> a, const std::vector<Made>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace vispline

#include "vispline/io/write_bag.h"

#include <cmath>

#include "vispline/bags/ros_encode.h"

namespace vispline {
namespace {

ros::Vector3 to_message(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

void set_triad(const Vector3d& value, ros::Vector3& v, double (&covariance)[9]) {
  const bool is_absent = value.array().isNaN().all();
  v = is_absent ? ros::Vector3{} : to_message(value);
  if (is_absent) covariance[0] = -1.0;
}

ros::Imu to_message(std::int64_t ns, const ImuSample& sample) {
  ros::Imu imu;
  imu.header = {.stamp_ns = ns, .frame_id = "imu"};
  imu.orientation_covariance[0] = -1.0;
  set_triad(sample.gyro, imu.angular_velocity, imu.angular_velocity_covariance);
  set_triad(sample.accel, imu.linear_acceleration, imu.linear_acceleration_covariance);
  return imu;
}

ros::PoseStamped to_message(std::int64_t ns, const Pose& T_w_b) {
  const Eigen::Quaterniond q = T_w_b.quaternion();
  ros::PoseStamped message;
  message.header = {.stamp_ns = ns, .frame_id = "world"};
  message.pose = {to_message(T_w_b.p), {q.x(), q.y(), q.z(), q.w()}};
  return message;
}

}  // namespace

SignalBagWriter::SignalBagWriter(Container container, const std::string& path, const BagWriterOptions& options)
    : writer_(make_bag_writer(container, path, options)),
      wire_(container == Container::kRosbag ? Wire::kRos1 : Wire::kCdr) {}

std::size_t SignalBagWriter::topic_number(const std::string& topic, const char* type) {
  const auto [at, is_new] = numbers_.try_emplace(topic, 0);
  if (is_new) at->second = writer_->add_topic(ros::make_topic(topic, type, wire_));
  return at->second;
}

std::int64_t SignalBagWriter::stamp(Time time) const {
  if (ros::stamp_fits(to_ns(time), wire_)) return to_ns(time);
  throw Error(ExitCode::kUnfit, {.code = "E-TIME-RANGE",
                                 .message = "a message cannot hold the stamp " + std::to_string(to_ns(time)) + " ns",
                                 .where = "",
                                 .effect = "nothing written",
                                 .next = "write a table, or a container of the other ROS"});
}

void SignalBagWriter::write_imu(const std::string& topic, std::span<const Time> time,
                                std::span<const ImuSample> samples) {
  const std::size_t number = topic_number(topic, "sensor_msgs/Imu");
  for (std::size_t i = 0; i < time.size(); ++i) {
    const std::int64_t ns = stamp(time[i]);
    ros::encode(to_message(ns, samples[i]), wire_, bytes_);
    writer_->write(number, ns, as_bytes(bytes_));
  }
}

void SignalBagWriter::write_poses(const std::string& topic, const Signal<Pose>& T_w_b) {
  const std::size_t number = topic_number(topic, "geometry_msgs/PoseStamped");
  for (std::size_t i = 0; i < T_w_b.size(); ++i) {
    const std::int64_t ns = stamp(T_w_b.time[i]);
    ros::encode(to_message(ns, T_w_b.value[i]), wire_, bytes_);
    writer_->write(number, ns, as_bytes(bytes_));
  }
}

}  // namespace vispline

#include "bag_output.h"

#include "vispline/bags/ros_encode.h"
#include "vispline/core/error.h"

namespace vispline::cli {
namespace {

Container container_of(const std::string& name) {
  if (name == "bag") return Container::kRosbag;
  return name == "mcap" ? Container::kMcap : Container::kRosbag2;
}

ros::Vector3 plain(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

ros::Pose plain(const Pose& T) {
  const Eigen::Quaterniond q = T.quaternion().normalized();
  return {plain(T.p), {q.x(), q.y(), q.z(), q.w()}};
}

ros::Header header(Time stamp, const std::string& frame_id) { return {.stamp_ns = to_ns(stamp), .frame_id = frame_id}; }

ros::Imu message_of(Time stamp, const ImuSample& sample, const std::string& name) {
  ros::Imu message;
  message.header = header(stamp, name);
  message.orientation_covariance[0] = -1.0;
  message.angular_velocity = plain(sample.gyro);
  message.linear_acceleration = plain(sample.accel);
  return message;
}

}  // namespace

std::string bag_path(const std::string& name, const std::string& folder) {
  return folder + (name == "rosbag2" ? "/rosbag2" : "/recording." + name);
}

BagOutput::BagOutput(const std::string& name, const std::string& folder, const Rig& rig, bool images, bool force)
    : wire_(name == "bag" ? Wire::kRos1 : Wire::kCdr),
      writer_(make_bag_writer(container_of(name), bag_path(name, folder), {.force = force})) {
  const auto add = [&](const std::string& topic, const char* type) {
    return writer_->add_topic(ros::make_topic(topic, type, wire_));
  };
  for (const Imu& imu : rig.imus) {
    imu_names_.push_back(imu.name);
    imu_topics_.push_back(add("/" + imu.name, "sensor_msgs/Imu"));
  }
  for (const Camera& camera : rig.cameras) {
    camera_names_.push_back(camera.name);
    if (images) camera_topics_.push_back(add("/" + camera.name + "/image_raw", "sensor_msgs/Image"));
  }
  truth_topic_ = add("/ground_truth/pose", "geometry_msgs/PoseStamped");
}

template <class Message>
void BagOutput::send(std::size_t topic, const Message& message) {
  const std::int64_t stamp_ns = message.header.stamp_ns;
  require(ros::stamp_fits(stamp_ns, wire_), "stamps from 0 to 2038 in a recording of messages");
  ros::encode(message, wire_, bytes_);
  writer_->write(topic, stamp_ns, as_bytes(bytes_));
}

void BagOutput::write(std::size_t imu, const SimulatedImu& block) {
  for (std::size_t i = 0; i < block.measured.size(); ++i) {
    send(imu_topics_[imu], message_of(block.measured.time[i], block.measured.value[i], imu_names_[imu]));
    if (imu > 0 || to_ns(block.body.time[i]) < 0) continue;
    send(truth_topic_,
         ros::PoseStamped{.header = header(block.body.time[i], "world"), .pose = plain(block.body.value[i].T_w_b())});
  }
}

void BagOutput::write(std::size_t camera, Time stamp, const GreyImage& image) {
  const auto width = static_cast<std::uint32_t>(image.width);
  send(camera_topics_[camera], ros::Image{.header = header(stamp, camera_names_[camera]),
                                          .height = static_cast<std::uint32_t>(image.height),
                                          .width = width,
                                          .encoding = "mono8",
                                          .step = width,
                                          .pixels = std::as_bytes(std::span(image.grey))});
}

}  // namespace vispline::cli

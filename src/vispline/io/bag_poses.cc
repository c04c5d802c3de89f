#include "vispline/io/bag_poses.h"

#include <optional>

#include "vispline/io/bag_messages.h"
#include "vispline/io/message_clock.h"
#include "vispline/io/topic_choice.h"

namespace vispline {
namespace {

struct StampedPose {
  ros::Header header;
  ros::Pose pose;
};

std::optional<StampedPose> decode_pose(const std::string& type, Bytes data, Wire wire) {
  std::optional<StampedPose> stamped;
  const auto keep = [&](const auto& message, const auto& member) {
    if (message) stamped = {message->header, (*message).*member};
  };
  if (type == kPoseTypes[0]) keep(ros::decode<ros::PoseStamped>(data, wire), &ros::PoseStamped::pose);
  if (type == kPoseTypes[1]) {
    keep(ros::decode<ros::PoseWithCovarianceStamped>(data, wire), &ros::PoseWithCovarianceStamped::pose);
  }
  if (type == kPoseTypes[2]) keep(ros::decode<ros::TransformStamped>(data, wire), &ros::TransformStamped::transform);
  if (type == kPoseTypes[3]) keep(ros::decode<ros::Odometry>(data, wire), &ros::Odometry::pose);
  return stamped;
}

RowValues values_of(const ros::Pose& pose) {
  const auto& [p, q] = pose;
  return {p.x, p.y, p.z, q.x, q.y, q.z, q.w};
}

}  // namespace

PoseRows load_bag_poses(ReadContext& context) {
  const auto reader = open_recording(context);
  const TopicChoice topic = choose_topic(context, reader->topics(), context.options().topic, "--topic", kPoseTypes);
  context.name_places(", topic " + vispline::quoted(topic.name) + ", message ");
  PoseRows kept{.rows = {}, .format = topic.type};
  StampScreen screen(context, [&](std::span<const SensorRow> block) {
    kept.rows.insert(kept.rows.end(), block.begin(), block.end());
  });
  MessageClock clock(context);
  read_messages(context, *reader, topic.wanted, [&](const Topic& each, const Message& message) {
    const auto stamped = decode_pose(topic.type, message.data, each.wire);
    if (!stamped) return false;
    screen.push({.ns = clock.stamp(stamped->header, message.receive_ns),
                 .values = values_of(stamped->pose),
                 .where = context.counts.read});
    return true;
  });
  screen.flush();
  check_constant_time(context, screen.rows_in_range(), screen.rows_kept());
  clock.judge();
  screen.judge(1.0);
  return kept;
}

}  // namespace vispline

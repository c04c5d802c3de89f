/// Poses of recordings of messages, in every type they come in.
#include "vispline/io/bag_testing.h"
#include "vispline/io/topic_choice.h"

namespace vispline {
namespace {

const Signal<Pose> kPoses = random_poses(300, 9);

Made pose_of_type(std::size_t type, Wire wire, Time time, const Pose& T_w_b) {
  const ros::Header header{.stamp_ns = to_ns(time), .frame_id = "w"};
  const ros::Pose pose = pose_message(T_w_b);
  const auto finish = [&](auto message, auto member) {
    message.header = header;
    message.*member = pose;
    return made("/pose", std::string(kPoseTypes[type]), wire, to_ns(time), message);
  };
  if (type == 0) return finish(ros::PoseStamped{}, &ros::PoseStamped::pose);
  if (type == 1) return finish(ros::PoseWithCovarianceStamped{}, &ros::PoseWithCovarianceStamped::pose);
  if (type == 2) return finish(ros::TransformStamped{}, &ros::TransformStamped::transform);
  return finish(ros::Odometry{}, &ros::Odometry::pose);
}

void expect_same_poses(const Signal<Pose>& a, const Signal<Pose>& b) {
  ASSERT_EQ(a.time, b.time);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a.value[i].p, b.value[i].p) << i;
    EXPECT_LT((a.value[i].R - b.value[i].R).norm(), 1e-14) << i;
  }
}

TEST(BagPoses, EveryTypeAndWire) {
  const ScratchFolder folder;
  for (std::size_t type = 0; type < kPoseTypes.size(); ++type) {
    for (const Container container : {Container::kRosbag, Container::kMcap}) {
      std::vector<Made> messages;
      for (std::size_t i = 0; i < kPoses.size(); ++i) {
        messages.push_back(pose_of_type(type, wire_of(container), kPoses.time[i], kPoses.value[i]));
      }
      const std::string path = write_bag(folder.path("f"), messages, container);
      const auto read = read_trajectory(path);
      expect_same_poses(read.value, kPoses);
      EXPECT_EQ(read.format, kPoseTypes[type]);
      EXPECT_TRUE(read.diagnostics.empty());
      EXPECT_EQ(content_of(path), ContentKind::kTrajectory);
    }
  }
}

TEST(BagPoses, PassTheSameChecksAsTables) {
  const ScratchFolder folder;
  std::vector<Made> messages;
  Signal<Pose> odd = kPoses;
  odd.value[10].p.x() = NAN;
  odd.value[20].R.setZero();
  for (std::size_t i = 0; i < odd.size(); ++i) {
    messages.push_back(pose_of_type(0, Wire::kRos1, odd.time[i], odd.value[i]));
  }
  messages[50].data.pop_back();
  const std::string path = write_bag(folder.path("f"), messages);
  EXPECT_EQ(trajectory_outcome(path, {.repair = true}).kept, 297);
}

}  // namespace
}  // namespace vispline

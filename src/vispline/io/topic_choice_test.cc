#include "vispline/io/topic_choice.h"

#include "vispline/io/bag_testing.h"

namespace vispline {
namespace {

constexpr std::int64_t kStart = 1'600'000'000'000'000'000;

std::vector<Made> poses_and_imus(const std::vector<std::string>& imu_topics) {
  std::vector<Made> messages;
  for (const std::string& topic : imu_topics)
    messages = messages + imu_messages(random_imu(50, 2, kStart), Wire::kRos1, topic);
  const Signal<Pose> poses = random_poses(50, 3, kStart);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    ros::PoseStamped message;
    message.header = {.stamp_ns = to_ns(poses.time[i]), .frame_id = "w"};
    message.pose = pose_message(poses.value[i]);
    messages.push_back(made("/pose", "geometry_msgs/PoseStamped", Wire::kRos1, to_ns(poses.time[i]), message));
  }
  return messages;
}

TEST(TopicChoice, TheOnlyOneNeedsNoName) {
  const ScratchFolder folder;
  const std::string path = write_bag(folder.path("f"), poses_and_imus({"/imu"}));
  EXPECT_EQ(read_imu(path).value.size(), 50u);
  EXPECT_EQ(read_trajectory(path).value.size(), 50u);
  EXPECT_EQ(content_of(path), ContentKind::kBoth);
  EXPECT_EQ(content_of(path, {.topic = "/imu"}), ContentKind::kImu);
  EXPECT_EQ(content_of(path, {.topic = "/pose"}), ContentKind::kTrajectory);
}

TEST(TopicChoice, SeveralAreAmbiguous) {
  const ScratchFolder folder;
  const std::string path = write_bag(folder.path("f"), poses_and_imus({"/imu0", "/imu1"}));
  const Outcome outcome = imu_outcome(path);
  EXPECT_EQ(outcome.codes, "E-TOPIC-AMBIGUOUS");
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_EQ(
      outcome.next,
      "pass --topic with one of '/imu0' ('sensor_msgs/Imu', 50 messages), '/imu1' ('sensor_msgs/Imu', 50 messages)");
  EXPECT_EQ(imu_outcome(path, {.topic = "/imu1"}).codes, "");
}

TEST(TopicChoice, AnAbsentOneNamesTheNearestFirst) {
  const ScratchFolder folder;
  const std::string path = write_bag(folder.path("f"), poses_and_imus({"/accelerometer", "/imu0"}));
  const Outcome outcome = imu_outcome(path, {.topic = "imu"});
  EXPECT_EQ(outcome.codes, "E-TOPIC");
  EXPECT_EQ(outcome.exit, 4);
  EXPECT_TRUE(outcome.next.starts_with("pass --topic with one of '/imu0' (")) << outcome.next;
}

TEST(TopicChoice, ATopicOfAnotherTypeIsNamedWithIt) {
  const ScratchFolder folder;
  const std::string path = write_bag(folder.path("f"), poses_and_imus({"/imu"}));
  const Outcome outcome = imu_outcome(path, {.topic = "/pose"});
  EXPECT_EQ(outcome.codes, "E-TYPE");
  EXPECT_EQ(outcome.exit, 4);
  EXPECT_NE(outcome.message.find("geometry_msgs/PoseStamped"), std::string::npos);
  const std::string poses = write_bag(folder.path("poses"), poses_and_imus({}));
  EXPECT_EQ(imu_outcome(poses).codes, "E-TOPIC");
}

Topic imu_topic() { return ros::make_topic("/imu", "sensor_msgs/Imu", Wire::kRos1); }

std::string code_of(const std::vector<Topic>& topics, const std::string& name = "/imu") {
  const ReadContext context("f", "IMU samples", {});
  try {
    choose_topic(context, topics, name, "--topic", kImuTypes);
    return "";
  } catch (const Error& error) {
    return error.diagnostic().code + " " + std::to_string(static_cast<int>(error.exit_code()));
  }
}

TEST(TopicChoice, SeveralConnectionsOfOneNameAreOneTopic) {
  EXPECT_EQ(code_of({imu_topic(), imu_topic()}), "");
  Topic other = imu_topic();
  other.type = "std_msgs/String";
  EXPECT_EQ(code_of({imu_topic(), other}), "E-TYPE 4");
}

TEST(TopicChoice, NothingIsDecodedByGuess) {
  Topic other_md5 = imu_topic(), protobuf = imu_topic();
  other_md5.md5[0] = '0';
  protobuf.wire = Wire::kOther;
  EXPECT_EQ(code_of({other_md5}), "E-TYPE 3");
  EXPECT_EQ(code_of({protobuf}), "E-UNSUPPORTED 3");
}

TEST(TopicChoice, EmptyTopicsDoNotMakeItAmbiguous) {
  Topic empty = imu_topic(), full = imu_topic();
  empty.count = 0;
  full.name = "/full";
  EXPECT_EQ(code_of({empty, full}, ""), "");
  EXPECT_EQ(code_of({empty}, ""), "");
  EXPECT_EQ(code_of({}, ""), "E-TOPIC 4");
}

TEST(TopicChoice, TableFlagsAreRefused) {
  const ScratchFolder folder;
  const std::string path = write_bag(folder.path("f"), poses_and_imus({"/imu"}));
  EXPECT_EQ(imu_outcome(path, {.columns = "t,gx,gy,gz,ax,ay,az"}).codes, "E-ARGUMENT");
  EXPECT_EQ(imu_outcome(path, {.time_unit = "ns"}).codes, "E-ARGUMENT");
  EXPECT_EQ(imu_outcome(path, {.rate_hz = 200.0}).codes, "E-ARGUMENT");
  EXPECT_EQ(imu_outcome(folder.write("t.csv", "t,gx,gy,gz,ax,ay,az\n"), {.topic = "/imu"}).codes, "E-ARGUMENT");
}

}  // namespace
}  // namespace vispline

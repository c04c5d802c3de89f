/// Recordings made by others, read with the counts their notes state. Skipped where they are not at hand.
#include <cmath>

#include "vispline/bags/bags_testing.h"
#include "vispline/bags/ros_messages.h"

namespace vispline {
namespace {

std::string data(const std::string& name) { return std::string(VISPLINE_SOURCE_DIR) + "/../shared/data/bags/" + name; }

std::int64_t messages_of(const BagOutcome& outcome, const std::string& topic) {
  return std::ranges::count_if(outcome.messages, [&](const Recorded& message) { return message.topic == topic; });
}

/// Every topic has as many messages as the index says.
void expect_counts(const BagOutcome& outcome) {
  for (const Topic& topic : outcome.topics) {
    EXPECT_EQ(messages_of(outcome, topic.name), topic.count.value_or(-1)) << topic.name;
  }
}

class RecordedBags : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(data("README.md"))) GTEST_SKIP() << "no recorded data at hand";
  }
};

TEST_F(RecordedBags, Rosbag) {
  struct File {
    const char *name, *topic;
    std::int64_t count;
  };
  for (const File& file : {File{"ISAS-Walk1.bag", "/waveshare_sense_hat_b", 4839},
                           {"ISAS-Walk1.bag", "/vive/transform/tracker_1_ref", 3168},
                           {"phidgets_imu_upside_down.bag", "/imu/data_raw", 13964},
                           {"sparkfun_razor_old_uncompressed.bag", "/imu/data_raw", 2144}}) {
    const BagOutcome outcome = outcome_of_file(data(file.name));
    EXPECT_EQ(outcome.codes, "") << file.name << outcome.text;
    EXPECT_TRUE(outcome.indexed) << file.name;
    EXPECT_EQ(messages_of(outcome, file.topic), file.count) << file.name;
    expect_counts(outcome);
    EXPECT_EQ(outcome_of_file(data(file.name), {.use_index = false}).messages, outcome.messages);
  }
}

TEST_F(RecordedBags, Mcap) {
  const BagOutcome walk = outcome_of_file(data("isas_walk1_mcap/isas_walk1_mcap.mcap"));
  EXPECT_EQ(walk.codes, "") << walk.text;
  EXPECT_EQ(messages_of(walk, "/waveshare_sense_hat_b"), 4839);
  EXPECT_EQ(messages_of(walk, "/vive/transform/tracker_1_ref"), 3168);
  for (const char* name :
       {"isas_walk1_mcap/isas_walk1_mcap.mcap", "evo_nav2_turtlebot.mcap", "ros2_talker_mcap/talker.mcap"}) {
    const BagOutcome outcome = outcome_of_file(data(name));
    EXPECT_EQ(outcome.codes, "") << name << outcome.text;
    EXPECT_TRUE(outcome.indexed) << name;
    expect_counts(outcome);
    EXPECT_EQ(outcome_of_file(data(name), {.use_index = false}).messages, outcome.messages) << name;
  }
}

TEST_F(RecordedBags, Rosbag2) {
  const BagOutcome razor = outcome_of_file(data("sparkfun_razor_db3"));
  EXPECT_EQ(razor.codes, "") << razor.text;
  EXPECT_GT(messages_of(razor, "/imu/data_raw"), 2000);
  const BagOutcome test = outcome_of_file(data("plotjuggler_rosbag2_test"));
  EXPECT_EQ(test.codes, "") << test.text;
  EXPECT_EQ(messages_of(test, "/imu"), 1565);
  EXPECT_EQ(test.messages.size(), 4695u);
  const BagOutcome walk = outcome_of_file(data("isas_walk1_mcap"));
  EXPECT_EQ(walk.codes, "") << walk.text;
  EXPECT_EQ(walk.messages.size(), 8007u);
  EXPECT_EQ(outcome_of_file(data("ros2_talker_mcap")).messages.size(), 20u);
}

/// Mean norm of the specific force of the messages of one topic; every one must decode.
double mean_force(const std::string& path, const std::string& name) {
  const auto reader = open_bag(path);
  double sum = 0;
  int count = 0;
  reader->read([&](const Topic& topic) { return topic.name == name; },
               [&](const Message& message) {
                 const Topic& topic = reader->topics()[message.topic];
                 EXPECT_EQ(ros::match(topic, "sensor_msgs/Imu"), ros::Match::kSame);
                 const auto imu = ros::decode<ros::Imu>(message.data, topic.wire);
                 EXPECT_TRUE(imu);
                 if (!imu) return false;
                 const ros::Vector3& a = imu->linear_acceleration;
                 sum += std::hypot(a.x, a.y, a.z);
                 ++count;
                 return true;
               });
  return sum / count;
}

TEST_F(RecordedBags, ImuMessages) {
  EXPECT_NEAR(mean_force(data("phidgets_imu_upside_down.bag"), "/imu/data_raw"), 9.88, 0.05);
  EXPECT_NEAR(mean_force(data("sparkfun_razor_old_uncompressed.bag"), "/imu/data_raw"), 10.07, 0.05);
  EXPECT_DOUBLE_EQ(mean_force(data("ISAS-Walk1.bag"), "/waveshare_sense_hat_b"),
                   mean_force(data("isas_walk1_mcap/isas_walk1_mcap.mcap"), "/waveshare_sense_hat_b"));
}

}  // namespace
}  // namespace vispline

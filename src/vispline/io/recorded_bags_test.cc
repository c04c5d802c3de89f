/// Recordings made by others become samples, with the counts their notes state. Skipped where they are not at hand.
#include "vispline/io/io_testing.h"
#include "vispline/io/recording_survey.h"

namespace vispline {
namespace {

std::string data(const std::string& name) { return std::string(VISPLINE_SOURCE_DIR) + "/../shared/data/bags/" + name; }

class RecordedSamples : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(data("README.md"))) GTEST_SKIP() << "no recorded data at hand";
  }
};

TEST_F(RecordedSamples, Imus) {
  struct File {
    const char* name;
    std::int64_t read;
    double norm, rate_hz;
  };
  for (const File& file : {File{"ISAS-Walk1.bag", 4839, 9.96, 81.9},
                           {"isas_walk1_mcap", 4839, 9.96, 81.9},
                           {"phidgets_imu_upside_down.bag", 13964, 9.88, 250.0},
                           {"sparkfun_razor_old_uncompressed.bag", 2144, 10.07, 69.0}}) {
    const auto imu = read_imu(data(file.name));
    EXPECT_EQ(imu.counts.read, file.read) << file.name;
    EXPECT_GT(imu.counts.kept, file.read * 99 / 100) << file.name;
    double norm = 0.0;
    for (const ImuSample& sample : imu.value.value) norm += sample.accel.norm() / static_cast<double>(imu.value.size());
    EXPECT_NEAR(norm, file.norm, 0.1) << file.name;
    EXPECT_NEAR(static_cast<double>(imu.value.size()) / imu.value.span().seconds(), file.rate_hz, 0.02 * file.rate_hz);
  }
  EXPECT_GT(read_imu(data("sparkfun_razor_db3")).counts.kept, 2000);
}

TEST_F(RecordedSamples, OneWalkInTwoContainers) {
  EXPECT_EQ(read_imu(data("ISAS-Walk1.bag")).value.time, read_imu(data("isas_walk1_mcap")).value.time);
  const auto walk = read_trajectory(data("ISAS-Walk1.bag"), {.topic = "/vive/transform/tracker_1_ref"});
  EXPECT_EQ(walk.counts.read, 3168);
}

TEST_F(RecordedSamples, ConstantsAreNoImu) {
  EXPECT_EQ(imu_outcome(data("plotjuggler_rosbag2_test")).codes, "E-CONSTANT");
  EXPECT_EQ(imu_outcome(data("plotjuggler_rosbag2_test"), {.repair = true}).read, 1565);
}

TEST_F(RecordedSamples, Odometry) {
  const std::string turtle = data("evo_nav2_turtlebot.mcap");
  EXPECT_GT(read_trajectory(turtle, {.topic = "/odom"}).value.size(), 10u);
  EXPECT_EQ(trajectory_outcome(turtle).codes, "E-TOPIC-AMBIGUOUS");
  EXPECT_EQ(imu_outcome(turtle).codes, "E-TOPIC");
}

TEST_F(RecordedSamples, StringsOnly) {
  const RecordingSurvey talker = survey_recording(data("ros2_talker_mcap"), {});
  EXPECT_EQ(talker.counts.read, 20);
  for (const TopicSurvey& topic : talker.topics) EXPECT_EQ(topic.use, TopicUse::kNone);
}

}  // namespace
}  // namespace vispline

/// Recordings made by others, read with the counts their notes state. Skipped where they are not at hand.
#include "vispline/bags/bags_testing.h"

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

}  // namespace
}  // namespace vispline

/// What a look at a recording or a table tells.
#include "vispline/io/bag_testing.h"
#include "vispline/io/read_testing.h"
#include "vispline/io/recording_survey.h"
#include "vispline/io/signal_survey.h"

namespace vispline {
namespace {

constexpr std::int64_t kStart = 1'600'000'000'000'000'000;

TEST(RecordingSurvey, EveryTopicWithItsRhythm) {
  const ScratchFolder folder;
  const ImuSignal imu = random_imu(1000, 1, kStart);
  std::vector<Made> messages = imu_messages(imu, Wire::kRos1, "/imu", 20'000'000);
  ros::Image image;
  image.header.stamp_ns = kStart;
  messages.push_back(made("/cam", "sensor_msgs/Image", Wire::kRos1, kStart, image));
  const RecordingSurvey survey = survey_recording(write_bag(folder.path("f"), messages), {});
  EXPECT_TRUE(survey.indexed);
  EXPECT_EQ(survey.counts.read, 1001);
  ASSERT_EQ(survey.topics.size(), 2u);
  const TopicSurvey& topic = survey.topics[0];
  EXPECT_EQ(topic.name, "/imu");
  EXPECT_EQ(topic.use, TopicUse::kImu);
  EXPECT_EQ(topic.receive.count, 1000);
  ASSERT_TRUE(topic.header);
  EXPECT_EQ(topic.header->begin_ns, kStart);
  EXPECT_EQ(topic.header->median_step_ns, 5'016'003);
  ASSERT_TRUE(topic.delay);
  EXPECT_EQ(topic.delay->median, -20'000'000);
  EXPECT_EQ(survey.topics[1].use, TopicUse::kImages);
}

TEST(RecordingSurvey, OneTopic) {
  const ScratchFolder folder;
  const ImuSignal imu = random_imu(30, 1, kStart);
  const std::string path =
      write_bag(folder.path("f"), imu_messages(imu, Wire::kRos1, "/a") + imu_messages(imu, Wire::kRos1, "/b"));
  const RecordingSurvey survey = survey_recording(path, {.topic = "/b"});
  ASSERT_EQ(survey.topics.size(), 1u);
  EXPECT_EQ(survey.counts.read, 30);
  EXPECT_THROW(survey_recording(path, {.topic = "/c"}), Error);
}

TEST(SignalSurvey, RangesAndLosses) {
  const ScratchFolder folder;
  const std::string path = folder.write("f.csv", edited([](Rows& rows) {
                                          rows[500].values[0] = 40.0;  // a spike
                                          std::swap(rows[700], rows[701]);
                                          rows[900] = rows[899];
                                        }));
  const SignalSurvey survey = survey_imu(path, {});
  ASSERT_FALSE(survey.error);
  EXPECT_EQ(survey.counts.read, kRows);
  EXPECT_EQ(survey.counts.kept, kRows - 2);
  EXPECT_EQ(survey.diagnostics.counts().at("W-SPIKE"), 1);
  EXPECT_EQ(survey.late, 1);
  ASSERT_TRUE(survey.imu);
  EXPECT_NEAR(survey.imu->axis[5].mean, 9.81, 0.1);
  EXPECT_NEAR(survey.imu->axis[0].standard_deviation, 0.3, 0.02);
  EXPECT_LT(survey.imu->axis[0].max, 2.0);
  EXPECT_NEAR(*survey.imu->median_accel, 9.9, 0.2);
  EXPECT_NEAR(*survey.rhythm.rate_hz(), 200.0, 0.3);
}

TEST(SignalSurvey, WhatOtherVerbsRefuseIsSaid) {
  const ScratchFolder folder;
  const std::string path = folder.write("f.csv", edited([](Rows& rows) {
                                          for (Row& row : rows) row.values.assign(6, 1.0);
                                        }));
  const SignalSurvey survey = survey_imu(path, {});
  ASSERT_TRUE(survey.error);
  EXPECT_EQ(survey.error->diagnostic().code, "E-CONSTANT");
  EXPECT_EQ(survey.rhythm.count, kRows);
}

TEST(SignalSurvey, TablesOfEitherKind) {
  const ScratchFolder folder;
  const auto poses = survey_tables(folder.write("p.csv",
                                                "t,px,py,pz,qx,qy,qz,qw\n0,0,0,0,0,0,0,1\n0.01,3,0,0,0,0,0,1\n"
                                                "0.02,3,4,0,0,0,0,1\n"),
                                   {});
  ASSERT_EQ(poses.size(), 1u);
  ASSERT_TRUE(poses[0].poses);
  EXPECT_DOUBLE_EQ(poses[0].poses->path_length, 7.0);
  EXPECT_EQ(poses[0].poses->max_w, Vector3d(3, 4, 0));
  EXPECT_EQ(survey_tables(folder.write("i.csv", text_of(healthy())), {}).size(), 1u);
  EXPECT_THROW(survey_tables(folder.write("n.csv", "a,b\n1,2\n"), {}), Error);
}

}  // namespace
}  // namespace vispline

/// Signals to recordings and back, and recordings into other containers.
#include "vispline/io/write_bag.h"

#include "vispline/io/bag_testing.h"
#include "vispline/io/copy_bag.h"
#include "vispline/io/imu_stream.h"

namespace vispline {
namespace {

constexpr Container kContainers[] = {Container::kRosbag, Container::kMcap, Container::kRosbag2};

TEST(SignalBagWriter, ReadsBackTheSame) {
  const ScratchFolder folder;
  const ImuSignal imu = random_imu(500, 1);
  const Signal<Pose> poses = random_poses(300, 2);
  for (const Container container : kContainers) {
    const std::string path = folder.path(std::to_string(static_cast<int>(container)));
    SignalBagWriter writer(container, path);
    writer.write_imu("/imu0", imu.time, imu.value);
    writer.write_poses("/pose", poses);
    writer.publish();
    const auto back = read_imu(path);
    ASSERT_EQ(back.value.time, imu.time);
    for (std::size_t i = 0; i < imu.size(); ++i) EXPECT_EQ(back.value.value[i].accel, imu.value[i].accel);
    EXPECT_EQ(read_trajectory(path).value.time, poses.time);
  }
}

TEST(SignalBagWriter, WhatIsNotMeasuredStaysSo) {
  const ScratchFolder folder;
  ImuSignal gyro = random_imu(50, 1);
  for (ImuSample& sample : gyro.value) sample.accel.setConstant(NAN);
  const std::string path = folder.path("f");
  SignalBagWriter writer(Container::kMcap, path);
  writer.write_imu("/gyro", gyro.time, gyro.value);
  writer.publish();
  const ImuStreamResult result = stream_imu(path, {}, [](std::span<const Time>, std::span<const ImuSample>) {});
  EXPECT_TRUE(result.has_gyro());
  EXPECT_FALSE(result.has_accel());
}

TEST(SignalBagWriter, StampsThatDoNotFit) {
  const ScratchFolder folder;
  const ImuSignal imu = random_imu(2, 1, 3'000'000'000'000'000'000);  // 2065
  SignalBagWriter ros1(Container::kRosbag, folder.path("1")), ros2(Container::kMcap, folder.path("2"));
  EXPECT_NO_THROW(ros1.write_imu("/imu", imu.time, imu.value));
  EXPECT_THROW(ros2.write_imu("/imu", imu.time, imu.value), Error);
}

TEST(CopyRecording, BetweenAllContainers) {
  const ScratchFolder folder;
  const ImuSignal imu = random_imu(200, 3);
  for (const Container from : kContainers) {
    const std::string source = write_bag(folder.path("from" + std::to_string(static_cast<int>(from))),
                                         imu_messages(imu, wire_of(from), "/imu", 5), from);
    for (const Container to : kContainers) {
      const std::string target = folder.path("to" + std::to_string(static_cast<int>(from) * 3 + static_cast<int>(to)));
      const CopyResult copied = copy_recording(source, {}, to, target, {});
      EXPECT_EQ(copied.counts.kept, 200);
      EXPECT_TRUE(copied.diagnostics.empty());
      const auto header = read_imu(target), receive = read_imu(target, {.clock = StampClock::kReceive});
      ASSERT_EQ(header.value.time, imu.time);
      for (std::size_t i = 0; i < imu.size(); ++i) {
        EXPECT_EQ(header.value.value[i].gyro, imu.value[i].gyro);
        EXPECT_EQ(receive.value.time[i], imu.time[i] + Duration(5));
      }
    }
  }
}

TEST(CopyRecording, OtherTypesStayOnlyWhereTheirBytesDo) {
  const ScratchFolder folder;
  const auto writer = make_bag_writer(Container::kRosbag, folder.path("f"));
  const std::size_t text = writer->add_topic({.name = "/text",
                                              .type = "std_msgs/String",
                                              .md5 = "992ce8a1687cec8c8bd883ec73ca41d1",
                                              .definition = "string data\n",
                                              .wire = Wire::kRos1});
  for (int i = 0; i < 5; ++i) writer->write(text, 1'600'000'000'000'000'000 + i, as_bytes("\1\0\0\0x"));
  writer->publish();
  EXPECT_EQ(copy_recording(folder.path("f"), {}, Container::kMcap, folder.path("m"), {}).counts.kept, 5);
  const CopyResult dropped = copy_recording(folder.path("f"), {}, Container::kRosbag2, folder.path("2"), {});
  EXPECT_EQ(dropped.counts.dropped.at("W-TYPE"), 5);
  EXPECT_EQ(dropped.counts.kept, 0);
}

TEST(CopyRecording, OneTopicOnly) {
  const ScratchFolder folder;
  const ImuSignal imu = random_imu(20, 3);
  const std::string source =
      write_bag(folder.path("f"), imu_messages(imu, Wire::kRos1, "/a") + imu_messages(imu, Wire::kRos1, "/b"));
  EXPECT_EQ(copy_recording(source, {.topic = "/b"}, Container::kMcap, folder.path("m"), {}).counts.read, 20);
  EXPECT_EQ(imu_outcome(folder.path("m")).kept, 20);
  EXPECT_THROW(copy_recording(source, {.topic = "/c"}, Container::kMcap, folder.path("n"), {}), Error);
  EXPECT_FALSE(std::filesystem::exists(folder.path("n")));
}

}  // namespace
}  // namespace vispline

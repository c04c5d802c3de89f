/// IMU samples of recordings of messages.
#include "vispline/io/bag_testing.h"
#include "vispline/io/stream_testing.h"

namespace vispline {
namespace {

const ImuSignal kImu = random_imu(3000, 5);

TEST(BagImu, EveryContainerGivesTheSameSamples) {
  const ScratchFolder folder;
  for (const Container container : {Container::kRosbag, Container::kMcap, Container::kRosbag2}) {
    const std::string path = write_bag(folder.path(std::to_string(static_cast<int>(container))),
                                       imu_messages(kImu, wire_of(container)), container);
    const auto read = read_imu(path);
    expect_same_samples(read.value, kImu);
    EXPECT_EQ(read.counts.read, 3000);
    EXPECT_TRUE(read.diagnostics.empty());
    EXPECT_EQ(read.format, "sensor_msgs/Imu");
    EXPECT_EQ(content_of(path), ContentKind::kImu);
  }
}

TEST(BagImu, HeaderStampsAndTimesOfArrivalAreNeverMixed) {
  const ScratchFolder folder;
  const std::string path = write_bag(folder.path("f"), imu_messages(kImu, Wire::kRos1, "/imu", 12'500'000));
  const auto header = read_imu(path), receive = read_imu(path, {.clock = StampClock::kReceive});
  EXPECT_EQ(header.value.time, kImu.time);
  EXPECT_EQ(header.diagnostics.counts().at("W-STAMP"), 1);
  EXPECT_NE(header.diagnostics.examples()[0].message.find("-12.5 ms"), std::string::npos);
  ASSERT_EQ(receive.value.size(), kImu.size());
  EXPECT_EQ(receive.value.time[7], kImu.time[7] + Duration(12'500'000));
}

TEST(BagImu, HeadersWithoutStampsAskForTheTimesOfArrival) {
  const ScratchFolder folder;
  std::vector<Made> messages;
  for (std::size_t i = 0; i < 200; ++i) {
    messages.push_back(
        made("/imu", "sensor_msgs/Imu", Wire::kRos1, to_ns(kImu.time[i]), imu_message(Time{}, kImu.value[i])));
  }
  const std::string path = write_bag(folder.path("f"), messages);
  const Outcome outcome = imu_outcome(path);
  EXPECT_EQ(outcome.codes, "E-TIME-CONSTANT");
  EXPECT_NE(outcome.next.find("--time receive"), std::string::npos);
  EXPECT_EQ(imu_outcome(path, {.clock = StampClock::kReceive}).codes, "W-STAMP");
}

TEST(BagImu, StampsPassTheSameScreenAsTheRowsOfTables) {
  const ScratchFolder folder;
  ImuSignal odd = kImu;
  std::swap(odd.time[40], odd.time[41]);
  std::swap(odd.value[40], odd.value[41]);
  odd.time[100] = odd.time[99];
  odd.value[200].gyro.x() = NAN;
  const Outcome outcome = imu_outcome(write_bag(folder.path("f"), imu_messages(odd, Wire::kRos1)));
  EXPECT_EQ(outcome.codes, "W-DUPLICATE W-NONFINITE W-ORDER") << outcome.message;
  EXPECT_EQ(outcome.kept, 2998);
}

TEST(BagImu, UnitsAreThoseOfRosUnlessAFlagSaysOtherwise) {
  const ScratchFolder folder;
  ImuSignal in_g = kImu;
  for (ImuSample& sample : in_g.value) sample.accel /= 9.80665;
  const std::string path = write_bag(folder.path("f"), imu_messages(in_g, Wire::kRos1));
  EXPECT_EQ(imu_outcome(path).codes, "W-UNITS");
  const auto read = read_imu(path, {.accel_unit = "g"});
  EXPECT_TRUE(read.diagnostics.empty());
  EXPECT_NEAR(read.value.value[3].accel.z(), kImu.value[3].accel.z(), 1e-14);
}

TEST(BagImu, DamagedMessagesAreLeftOut) {
  const ScratchFolder folder;
  std::vector<Made> messages = imu_messages(kImu, Wire::kRos1);
  for (std::size_t i = 0; i < 30; ++i) messages[100 * i].data.resize(300);
  const Outcome few = imu_outcome(write_bag(folder.path("few"), messages));
  EXPECT_EQ(few.codes, "W-MESSAGE W-RATE");
  EXPECT_EQ(few.kept, 2970);
  for (std::size_t i = 0; i < 60; ++i) messages[50 * i].data.resize(300);
  const std::string many = write_bag(folder.path("many"), messages);
  EXPECT_EQ(imu_outcome(many).codes, "E-MESSAGE");
  EXPECT_EQ(imu_outcome(many, {.repair = true}).kept, 2940);
}

TEST(BagImu, ATriadThatIsNotMeasuredIsAbsent) {
  const ScratchFolder folder;
  std::vector<Made> messages;
  for (std::size_t i = 0; i < 100; ++i) {
    ros::Imu imu = imu_message(kImu.time[i], {kImu.value[i].gyro, Vector3d::Zero()});
    imu.linear_acceleration_covariance[0] = -1;
    messages.push_back(made("/gyro", "sensor_msgs/Imu", Wire::kRos1, to_ns(kImu.time[i]), imu));
  }
  const std::string path = write_bag(folder.path("f"), messages);
  EXPECT_EQ(imu_outcome(path).codes, "E-TYPE");
  const Streamed gyro = streamed(path);
  EXPECT_EQ(gyro.error, "");
  EXPECT_TRUE(gyro.result.has_gyro());
  EXPECT_FALSE(gyro.result.has_accel());
  EXPECT_TRUE(std::isnan(gyro.imu.value[0].accel.x()));
}

TEST(BagImu, ProgressMayEndTheReading) {
  const ScratchFolder folder;
  const std::string path = write_bag(folder.path("f"), imu_messages(kImu, Wire::kRos1));
  struct Stop {};
  const ImuSink ignore = [](std::span<const Time>, std::span<const ImuSample>) {};
  EXPECT_THROW(stream_imu(path, {}, ignore, {.progress = [](std::uint64_t, std::uint64_t) { throw Stop(); }}), Stop);
}

}  // namespace
}  // namespace vispline

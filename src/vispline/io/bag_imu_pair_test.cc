/// A gyroscope and an accelerometer on two topics.
#include "vispline/io/bag_imu_pair.h"

#include <algorithm>

#include "vispline/io/bag_testing.h"

namespace vispline {
namespace {

constexpr std::int64_t kStart = 1'600'000'000'000'000'000;

/// The specific force is linear in time, so that interpolation is exact.
Vector3d force_at(std::int64_t ns) {
  const double t = static_cast<double>(ns - kStart) * 1e-9;
  return {t, -2.0 * t, 9.81 + 0.5 * t};
}

/// Gyroscope at 200 Hz from the start, accelerometer at 125 Hz from 3 ms after it; as they would arrive.
std::vector<Made> two_topics(std::int64_t accel_begin, std::int64_t accel_end) {
  Numbers numbers(3);
  std::vector<Made> messages;
  const auto add = [&](const std::string& topic, std::int64_t ns, const ImuSample& sample) {
    messages.push_back(made(topic, "sensor_msgs/Imu", Wire::kRos1, ns, imu_message(time_from_ns(ns), sample)));
  };
  for (std::int64_t i = 0; i < 2000; ++i) add("/gyro", kStart + i * 5'000'000, {numbers.vector(), Vector3d::Zero()});
  for (std::int64_t ns = accel_begin; ns <= accel_end; ns += 8'000'000) {
    add("/accel", ns, {Vector3d::Zero(), force_at(ns)});
  }
  std::ranges::stable_sort(messages, {}, &Made::receive_ns);
  return messages;
}

const ReadOptions kPair{.gyro_topic = "/gyro", .accel_topic = "/accel"};

TEST(BagImuPair, SpecificForceIsInterpolatedAtTheStampsOfTheGyroscope) {
  const ScratchFolder folder;
  const std::string path =
      write_bag(folder.path("f"), two_topics(kStart - 4'000'000, kStart + 2000 * std::int64_t{5'000'000}));
  const auto read = read_imu(path, kPair);
  EXPECT_TRUE(read.diagnostics.empty()) << to_text(read.diagnostics.examples().front());
  ASSERT_EQ(read.value.size(), 2000u);
  for (std::size_t i = 0; i < read.value.size(); ++i) {
    EXPECT_NEAR((read.value.value[i].accel - force_at(to_ns(read.value.time[i]))).norm(), 0.0, 1e-12) << i;
  }
  EXPECT_EQ(imu_outcome(path).codes, "E-TOPIC-AMBIGUOUS");
}

TEST(BagImuPair, SamplesWithoutAPartnerAreCounted) {
  const ScratchFolder folder;
  const std::string path = write_bag(folder.path("f"), two_topics(kStart + 12'000'000, kStart + 9'980'000'000));
  const auto read = read_imu(path, kPair);
  EXPECT_EQ(read.counts.read, 2000);
  EXPECT_EQ(read.counts.dropped.at("W-UNPAIRED"), 6);  // 0, 5, 10 ms; 9985, 9990, 9995 ms
  EXPECT_EQ(read.counts.kept, 1994);
}

TEST(BagImuPair, BothTopicsMustBeNamed) {
  const ScratchFolder folder;
  const std::string path = write_bag(folder.path("f"), two_topics(kStart, kStart + 1'000'000'000));
  EXPECT_EQ(imu_outcome(path, {.gyro_topic = "/gyro"}).codes, "E-ARGUMENT");
  EXPECT_EQ(imu_outcome(path, {.topic = "/imu", .gyro_topic = "/gyro", .accel_topic = "/accel"}).codes, "E-ARGUMENT");
  EXPECT_EQ(imu_outcome(path, {.gyro_topic = "/gyro", .accel_topic = "/axxel"}).codes, "E-TOPIC");
}

}  // namespace
}  // namespace vispline

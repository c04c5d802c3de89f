#include "vispline/io/ulog.h"

#include "vispline/io/io_testing.h"
#include "vispline/io/recorders_testing.h"

namespace vispline {
namespace {

using namespace recorders_testing;

TEST(Ulog, SensorCombinedWithALaterAccelerometer) {
  const ScratchFolder folder;
  const auto read = read_imu(folder.write("log.ulg", combined_ulog()));
  EXPECT_EQ(read.format, "ulog");
  EXPECT_EQ(read.counts.read, 20);
  ASSERT_EQ(read.counts.kept, 19);  // the accelerometer ends before the last gyroscope sample
  EXPECT_EQ(read.counts.dropped.at("W-UNPAIRED"), 1);
  for (std::size_t i = 0; i < 19; ++i) {
    const double t = 0.004 * static_cast<double>(i);
    EXPECT_EQ(to_ns(read.value.time[i]), 1'000'000'000 + 4'000'000 * static_cast<std::int64_t>(i));
    EXPECT_LE((read.value.value[i].gyro - Vector3d(0.5, -t, 2 * t)).norm(), 1e-7);
    // stamped 1 ms early, interpolated to the stamp of the gyroscope: a quarter of a step on
    EXPECT_LE((read.value.value[i].accel - Vector3d(t + 0.001, 1.001 + t, -9.75)).norm(), 1e-6) << i;
  }
}

TEST(Ulog, IncrementsOverTheirInterval) {
  UlogBytes log;
  log.format(
      "vehicle_imu:uint64_t timestamp;uint64_t timestamp_sample;uint32_t accel_device_id;float[3] delta_angle;"
      "float[3] delta_velocity;uint32_t delta_angle_dt;uint32_t delta_velocity_dt;");
  log.subscribe(1, "vehicle_imu", 1);
  log.subscribe(2, "vehicle_imu", 0);
  for (std::uint64_t i = 0; i < 12; ++i) {
    const double k = static_cast<double>(i);
    const std::string stamps = u64(5'000'900 + 5000 * i) + u64(5'000'000 + 5000 * i) + u32(9);
    log.data(1, stamps + floats({9, 9, 9}) + floats({9, 9, 9}) + u32(5000) + u32(5000));
    log.data(2, stamps + floats(0.005 * Vector3d(0.1, 0.2 + k, 0.3)) + floats(0.005 * Vector3d(k, 0, -9.8)) +
                    u32(5000) + u32(5000));
  }
  const ScratchFolder folder;
  const auto read = read_imu(folder.write("log.ulg", log.bytes));
  ASSERT_EQ(read.counts.kept, 12);
  EXPECT_EQ(to_ns(read.value.time[3]), 5'015'000'000);
  EXPECT_LE((read.value.value[3].gyro - Vector3d(0.1, 3.2, 0.3)).norm(), 1e-6);
  EXPECT_LE((read.value.value[3].accel - Vector3d(3, 0, -9.8)).norm(), 1e-5);
}

std::string apart(bool with_accel) {
  UlogBytes log;
  log.format("sensor_gyro:uint64_t timestamp;uint32_t device_id;float x;float y;float z;");
  log.format("sensor_accel:uint64_t timestamp;uint32_t device_id;float x;float y;float z;");
  log.subscribe(0, "sensor_gyro");
  if (with_accel) log.subscribe(1, "sensor_accel");
  for (std::uint64_t i = 0; i < 16; ++i) {
    const double k = static_cast<double>(i);
    if (with_accel && i % 2 == 0) log.data(1, u64(1'000'000 + 2500 * i) + u32(1) + floats({k, 0.5, -9.8}));
    log.data(0, u64(1'000'000 + 2500 * i) + u32(1) + floats({0.1 * k, 0.2, k}));
  }
  return log.bytes;
}

TEST(Ulog, GyroscopeAndAccelerometerApart) {
  const ScratchFolder folder;
  const auto read = read_imu(folder.write("log.ulg", apart(true)));
  ASSERT_EQ(read.counts.kept, 15);
  EXPECT_LE((read.value.value[5].accel - Vector3d(5, 0.5, -9.8)).norm(), 1e-6);
  const Outcome alone = imu_outcome(folder.write("gyro.ulg", apart(false)));
  EXPECT_EQ(alone.codes, "E-COLUMNS");
}

TEST(Ulog, AnAccelerometerAtNoTimeAtAll) {
  UlogBytes log;
  log.format(
      "sensor_combined:uint64_t timestamp;float[3] gyro_rad;int64_t accelerometer_timestamp_relative;"
      "float[3] accelerometer_m_s2;");
  log.subscribe(7, "sensor_combined");
  for (std::uint64_t i = 0; i < 16; ++i) {
    const std::uint64_t later = i == 5 ? 0x7ffffffffffffffeull : i == 6 ? 0x8000000000000000ull : 0;
    const double k = static_cast<double>(i);
    log.data(7, u64(1'000'000 + 4000 * i) + floats({0.1 * k, 2, 3}) + u64(later) + floats({0, 0.1 * k, -9.8}));
  }
  const ScratchFolder folder;
  EXPECT_EQ(read_imu(folder.write("log.ulg", log.bytes)).counts.kept, 16);
}

TEST(Ulog, WhatIsRefused) {
  const ScratchFolder folder;
  UlogBytes log;
  EXPECT_EQ(imu_outcome(folder.write("empty.ulg", log.bytes)).codes, "E-TOPIC");
  log.message('B', std::string(8, '\0') + "\2" + std::string(31, '\0'));
  EXPECT_EQ(imu_outcome(folder.write("newer.ulg", log.bytes)).codes, "E-UNSUPPORTED");
}

TEST(Ulog, DamageIsPassedOverToTheNextMark) {
  std::string bytes = combined_ulog(20);
  const std::string sync("\x08\0S\x2f\x73\x13\x20\x25\x0c\xbb\x12", 11);
  const std::string more = combined_ulog(40);
  const std::string tail = more.substr(bytes.size());  // the samples from 20 on
  const ScratchFolder folder;
  const auto read = read_imu(folder.write("log.ulg", bytes + "\xff\xff\xff garbage" + sync + tail));
  EXPECT_EQ(read.counts.kept, 39);
  EXPECT_EQ(read.diagnostics.counts().at("W-CORRUPT"), 1);
}

// The first part of a log that was continued may end anywhere; the second starts at its own offset.
TEST(Ulog, AppendedData) {
  UlogBytes log;
  const std::string whole = combined_ulog(30), first = combined_ulog(20);
  const std::string head = whole.substr(0, 16), cut = first.substr(16, first.size() - 16 - 5);
  const std::size_t flag_bytes = 3 + 40;
  const std::uint64_t offset = 16 + flag_bytes + cut.size();
  log.message('B', std::string(8, '\0') + "\1" + std::string(7, '\0') + u64(offset) + u64(0) + u64(0));
  const ScratchFolder folder;
  const auto read = read_imu(folder.write("log.ulg", log.bytes + cut + whole.substr(first.size())));
  EXPECT_EQ(read.counts.read, 29);  // the message at the seam is lost
}

TEST(Ulog, LongLogInWindows) {
  const auto read = ulog::stream(Input::from_memory(combined_ulog(20000), "long"), {}, kNoSink,
                                 {.window_rows = 64, .whole_imu = true});
  EXPECT_EQ(read.counts.kept, 19999);
  EXPECT_LE(read.largest_window, 8u * 64u);
}

TEST(Ulog, CutAtEveryByte) {
  const std::string whole = combined_ulog(14);
  std::int64_t most = 0;
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    std::int64_t kept = 0;
    try {
      kept =
          ulog::stream(Input::from_memory(whole.substr(0, size), "cut"), {}, kNoSink, {.whole_imu = true}).counts.kept;
    } catch (const Error& error) {
      EXPECT_EQ(error.diagnostic().code.substr(0, 2), "E-");
    }
    EXPECT_GE(kept, most) << size;
    most = std::max(most, kept);
  }
  EXPECT_EQ(most, 13);
}

}  // namespace
}  // namespace vispline

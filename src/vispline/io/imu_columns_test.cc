/// Columns, units and stamps that flags settle: no times, stamps in two columns, only some axes.
#include <cmath>

#include "vispline/io/stream_testing.h"

namespace vispline {
namespace {

constexpr double kDegree = 0.017453292519943295;

TEST(ImuColumns, SamplesAtARateHaveNoDrift) {
  const ScratchFolder folder;
  std::string text;
  for (int i = 0; i < 3000; ++i) text += std::to_string(i % 17) + ",1,2,3,4,9\n";
  const ReadOptions options{.columns = "gx,gy,gz,ax,ay,az", .rate_hz = 3.0e3 / 7};
  const Streamed got = streamed(folder.write("f.csv", text), options);
  EXPECT_EQ(got.error, "");
  ASSERT_EQ(got.imu.size(), 3000u);
  const SampleClock clock{.start = Time{}, .rate_hz = 3.0e3 / 7};
  for (std::int64_t i = 0; i < 3000; ++i) ASSERT_EQ(got.imu.time[static_cast<std::size_t>(i)], clock(i));
  EXPECT_EQ(to_ns(got.imu.time[0]), 0);
  EXPECT_EQ(to_ns(got.imu.time[3]), 7'000'000);
}

TEST(ImuColumns, ARowThatIsLeftOutKeepsItsTime) {
  const ScratchFolder folder;
  std::string text;
  for (int i = 0; i < 2000; ++i)
    text += i == 5 ? "x,1,2,3,4,9\n" : (i == 7 ? "nan" : std::to_string(i)) + ",1,2,3,4,9\n";
  const ReadOptions options{.columns = "gx,gy,gz,ax,ay,az", .rate_hz = 200, .skip_bad_rows = true};
  const Streamed got = streamed(folder.write("f.csv", text), options);
  ASSERT_EQ(got.imu.size(), 1998u);
  EXPECT_EQ(to_ns(got.imu.time[5]), 30'000'000);
  EXPECT_EQ(to_ns(got.imu.time[6]), 40'000'000);
}

TEST(ImuColumns, ACountOfSamplesAtARate) {
  const ScratchFolder folder;
  const std::string text = "index,gx,gy,gz,ax,ay,az\n10,1,2,3,4,5,9\n12,1,2,3,4,5,8\n-1,1,2,3,4,5,8\n";
  const Streamed got = streamed(folder.write("f.csv", text), {.rate_hz = 100, .repair = true});
  ASSERT_EQ(got.imu.size(), 2u) << got.error;
  EXPECT_EQ(to_ns(got.imu.time[0]), 100'000'000);
  EXPECT_EQ(to_ns(got.imu.time[1]), 120'000'000);
  EXPECT_EQ(got.counts.dropped.at("W-TIME-RANGE"), 1);
}

TEST(ImuColumns, StampsInTwoColumns) {
  const ScratchFolder folder;
  const std::string rows =
      "1520530308,995000000,1,2,3,4,5,9\n1520530309,0,1,2,3,4,5,8\n1520530309,5000001,1,2,3,4,5,9\n";
  for (const char* header :
       {"sec,nsec,gx,gy,gz,ax,ay,az\n", "header.stamp.sec,header.stamp.nanosec,gx,gy,gz,ax,ay,az\n"}) {
    const Streamed got = streamed(folder.write("f.csv", header + rows));
    ASSERT_EQ(got.imu.size(), 3u) << got.error;
    EXPECT_EQ(to_ns(got.imu.time[0]), 1520530308995000000);
    EXPECT_EQ(to_ns(got.imu.time[1]), 1520530309000000000);
    EXPECT_EQ(to_ns(got.imu.time[2]), 1520530309005000001);
  }
  const Streamed reversed =
      streamed(folder.write("f.csv", "5000000 1520530309 1 2 3 4 5 9\n10000000 1520530309 1 2 3 4 5 9\n"),
               {.columns = "nsec,sec,gx,gy,gz,ax,ay,az"});
  ASSERT_EQ(reversed.imu.size(), 2u) << reversed.error;
  EXPECT_EQ(to_ns(reversed.imu.time[1]), 1520530309010000000);
}

TEST(ImuColumns, NanosecondsOfASecondAndMoreAreNoTime) {
  const ScratchFolder folder;
  for (const char* nsec : {"1000000000", "-5", "0.5", "nan"}) {
    std::string text = "sec,nsec,gx,gy,gz,ax,ay,az\n";
    for (int i = 0; i < 200; ++i) {
      text += "7," + (i == 100 ? nsec : std::to_string(5000000 * i)) + "," + std::to_string(i) + ",2,3,4,5,9\n";
    }
    const Streamed got = streamed(folder.write("f.csv", text));
    EXPECT_EQ(got.error, "");
    ASSERT_EQ(got.counts.kept, 199) << nsec;
    EXPECT_EQ(got.counts.dropped.at("W-TIME-RANGE"), 1);
  }
}

TEST(ImuColumns, AGyroscopeAlone) {
  const ScratchFolder folder;
  std::string text = "t,gx,gy,gz\n";
  for (int i = 0; i < 300; ++i)
    text += std::to_string(0.005 * i) + "," + std::to_string(i % 7) + ",2." + std::to_string(i % 3) + ",3\n";
  const Streamed got = streamed(folder.write("f.csv", text));
  ASSERT_EQ(got.imu.size(), 300u) << got.error;
  EXPECT_TRUE(got.result.has_gyro());
  EXPECT_FALSE(got.result.has_accel());
  EXPECT_EQ(got.imu.value[8].gyro, Vector3d(1, 2.2, 3));
  EXPECT_TRUE(got.imu.value[8].accel.array().isNaN().all());
  ASSERT_EQ(got.warnings.size(), 2u);
  EXPECT_EQ(got.warnings[0], "W-CONSTANT x1");
  EXPECT_EQ(imu_outcome(folder.path("f.csv")).codes, "E-COLUMNS");
}

TEST(ImuColumns, OneAxisByFlag) {
  const ScratchFolder folder;
  std::string text;
  for (int i = 0; i < 300; ++i) text += "x;" + std::to_string(9.0 + i % 5) + "\n";
  const Streamed got = streamed(folder.write("f.csv", text), {.columns = "-,az", .rate_hz = 100, .accel_unit = "mg"});
  ASSERT_EQ(got.imu.size(), 300u) << got.error;
  EXPECT_TRUE(got.result.has_accel());
  EXPECT_FALSE(got.result.has_gyro());
  EXPECT_NEAR(got.imu.value[1].accel.z(), 10 * 9.80665e-3, 1e-15);
  EXPECT_TRUE(std::isnan(got.imu.value[1].accel.x()));
}

TEST(ImuColumns, UnitFlagsWinOverTheHeader) {
  const ScratchFolder folder;
  const std::string path = folder.write(
      "f.csv", "t,gx [furlong],gy [deg/s],gz,ax [g],ay [g],az [g]\n0.01,180,1,2,3,4,5\n0.02,180,1,2,3,4,6\n");
  EXPECT_EQ(imu_outcome(path).codes, "E-COLUMNS");
  const Streamed got = streamed(path, {.gyro_unit = "deg/h", .accel_unit = "m/s^2"});
  ASSERT_EQ(got.imu.size(), 2u) << got.error;
  EXPECT_NEAR(got.imu.value[0].gyro.x(), 180 * kDegree / 3600, 1e-18);
  EXPECT_EQ(got.imu.value[0].accel.z(), 5.0);
  EXPECT_EQ(streamed(path, {.gyro_unit = "rad/s"}).imu.value[0].gyro.x(), 180.0);
  EXPECT_NEAR(streamed(path, {.gyro_unit = "deg/s"}).imu.value[0].accel.z(), 5 * 9.80665, 1e-14);
}

TEST(ImuColumns, FlagsThatContradict) {
  const ScratchFolder folder;
  const std::string good = text_of(healthy());
  const std::string bare = "1,2,3,4,5,6\n1,2,3,4,5,7\n";
  const std::string all = "gx,gy,gz,ax,ay,az";
  check({
      {"gyro unit", good, "E-ARGUMENT", 2, 0, {.gyro_unit = "m/s^2"}},
      {"accel unit", good, "E-ARGUMENT", 2, 0, {.accel_unit = "G/s"}},
      {"a rate and times", good, "E-ARGUMENT", 2, 0, {.rate_hz = 200}},
      {"a rate and no times", bare, "", 0, 2, {.columns = all, .rate_hz = 200}},
      {"times left out", good, "", 0, kRows, {.columns = "-," + all, .rate_hz = 200}},
      {"no rate", bare, "E-TIME-UNIT", 3, 0, {.columns = all}},
      {"a rate and a unit", bare, "E-ARGUMENT", 2, 0, {.columns = all, .time_unit = "index@200", .rate_hz = 200}},
      {"a rate below zero", bare, "E-ARGUMENT", 2, 0, {.columns = all, .rate_hz = -1}},
      {"a rate that is none", bare, "E-ARGUMENT", 2, 0, {.columns = all, .rate_hz = NAN}},
      {"nanoseconds alone", "nsec," + all + "\n1,1,2,3,4,5,6\n2,1,2,3,4,5,6\n", "E-TIME-UNIT", 3, 0, {}},
  });
}

/// gyro_accel.csv of the phone logger MARS.
TEST(ImuColumns, PhoneLogs) {
  const ScratchFolder folder;
  const Streamed got = streamed(
      folder.write("gyro_accel.csv",
                   "Timestamp[nanosec],gx[rad/s],gy[rad/s],gz[rad/s],ax[m/s^2],ay[m/s^2],az[m/s^2],Unix time[nanosec]\n"
                   "1234567890123,0.1,0.2,0.3,0.4,0.5,9.8,1600000000000000000\n"
                   "1234572890123,0.1,0.2,0.3,0.4,0.5,9.7,1600000000005000000\n"));
  ASSERT_EQ(got.imu.size(), 2u) << got.error;
  EXPECT_EQ(to_ns(got.imu.time[0]), 1234567890123);
  EXPECT_EQ(got.imu.value[1].accel, Vector3d(0.4, 0.5, 9.7));
}

std::string gcsv(const std::string& scales) {
  return "GYROFLOW IMU LOG\nversion,1.3\nid,some, logger\norientation,YxZ\n" + scales +
         "t,gx,gy,gz,ax,ay,az\n100,10,20,30,0,0,2000\n105,10,20,30,0,0,2001\n";
}

TEST(ImuColumns, GyroflowLogs) {
  const ScratchFolder folder;
  const auto read = [&](const std::string& scales) { return streamed(folder.write("f.gcsv", gcsv(scales))); };
  const Streamed got = read("tscale,0.001\ngscale,0.01\nascale,0.0005\n");
  ASSERT_EQ(got.imu.size(), 2u) << got.error;
  EXPECT_EQ(got.result.format, "gcsv");
  EXPECT_EQ(to_ns(got.imu.time[1]), 105'000'000);
  EXPECT_LT((got.imu.value[0].gyro - Vector3d(0.1, 0.2, 0.3)).norm(), 1e-15);
  EXPECT_DOUBLE_EQ(got.imu.value[0].accel.z(), 9.80665);
  EXPECT_EQ(to_ns(read("tscale,0.0005\ngscale,1\nascale,1\n").imu.time[0]), 50'000'000);
  EXPECT_NE(read("gscale,1\nascale,1\n").error.find("tscale"), std::string::npos);
  EXPECT_NE(read("tscale,0.001\ngscale,-1\nascale,1\n").error.find("gscale"), std::string::npos);
  EXPECT_NE(read("tscale,0.0003\ngscale,1\nascale,1\n").error.find("tscale"), std::string::npos);
}

}  // namespace
}  // namespace vispline

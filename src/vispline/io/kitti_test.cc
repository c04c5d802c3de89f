#include "vispline/io/kitti.h"

#include "vispline/io/io_testing.h"
#include "vispline/io/write.h"

namespace vispline {
namespace {

TEST(Kitti, WritesAndReadsBack) {
  const ScratchFolder folder;
  const Signal<Pose> wrote = random_poses(30, 5, 0);
  const std::string path = folder.path("poses.txt");
  write_trajectory_kitti(path, wrote);
  const auto read = read_trajectory(path, {.rate_hz = 10.0});
  EXPECT_EQ(read.format, "kitti");
  ASSERT_EQ(read.counts.kept, 30);
  for (std::size_t i = 0; i < 30; ++i) {
    EXPECT_EQ(to_ns(read.value.time[i]), 100'000'000 * static_cast<std::int64_t>(i));
    EXPECT_LE((read.value.value[i].R - wrote.value[i].R).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_EQ(read.value.value[i].p, wrote.value[i].p);
  }
  EXPECT_EQ(content_of(path), ContentKind::kTrajectory);
  EXPECT_EQ(to_ns(read_trajectory(path, {.time_unit = "index@20"}).value.time[3]), 150'000'000);
}

// The first two poses of sequence 00 as its file has them: seven digits.
constexpr const char* kRows =
    "1.000000e+00 9.043680e-12 2.326809e-11 5.551115e-17 9.043683e-12 1.000000e+00 2.392370e-10 3.330669e-16 "
    "2.326810e-11 2.392370e-10 9.999999e-01 -4.440892e-16\n"
    "9.999978e-01 5.272628e-04 -2.066935e-03 -4.690294e-02 -5.296506e-04 9.999992e-01 -1.154865e-03 -2.839928e-02 "
    "2.066324e-03 1.155958e-03 9.999971e-01 8.586941e-01\n";

TEST(Kitti, RowByRow) {
  const ScratchFolder folder;
  const auto read = read_trajectory(folder.write("00.txt", kRows), {.rate_hz = 9.65});
  ASSERT_EQ(read.counts.kept, 2);
  EXPECT_EQ(read.value.value[1].p, Vector3d(-4.690294e-02, -2.839928e-02, 8.586941e-01));
  EXPECT_NEAR(read.value.value[1].R(0, 2), -2.066935e-03, 1e-6);
  EXPECT_NEAR(read.value.value[1].R(2, 0), 2.066324e-03, 1e-6);
}

TEST(Kitti, WhatIsRefused) {
  const ScratchFolder folder;
  const std::string path = folder.write("00.txt", kRows);
  EXPECT_EQ(trajectory_outcome(path).codes, "E-TIME-UNIT");  // there is no time in it
  const std::string numbers = folder.write("n.txt", "1 2 3 4 5 6 7 8 9 10 11 12\n");
  EXPECT_EQ(trajectory_outcome(numbers, {.rate_hz = 10.0}).codes, "E-COLUMNS");
  EXPECT_EQ(trajectory_outcome(numbers, {.format = "kitti", .rate_hz = 10.0}).codes, "E-CSV");
  std::string mirrored(kRows);
  mirrored.replace(mirrored.find("1.000000e+00"), 12, "-1.00000e+00");
  EXPECT_EQ(trajectory_outcome(folder.write("m.txt", mirrored), {.format = "kitti", .rate_hz = 10.0}).codes, "E-CSV");
}

TEST(Kitti, CutAtEveryByte) {
  const ScratchFolder folder;
  const std::string row = "1 0 0 0.5 0 0 -1 0 0 1 0 2.25\n", whole = row + row + row + row;
  std::int64_t most = 0;
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    const Outcome cut =
        trajectory_outcome(folder.write("cut.txt", whole.substr(0, size)), {.format = "kitti", .rate_hz = 10.0});
    EXPECT_TRUE(cut.exit == 0 || cut.codes.starts_with("E-")) << size;
    EXPECT_GE(cut.kept, cut.exit == 0 ? most : 0) << size;
    most = std::max(most, cut.kept);
  }
  EXPECT_EQ(most, 4);
}

TEST(Gcsv, WritesAndReadsBack) {
  const ScratchFolder folder;
  const ImuSignal wrote = random_imu(40, 3);
  const std::string path = folder.path("imu.gcsv");
  write_imu_gcsv(path, wrote, 0.0162);
  const auto read = read_imu(path);
  EXPECT_EQ(read.format, "gcsv");
  ASSERT_EQ(read.value.time, wrote.time);
  for (std::size_t i = 0; i < wrote.size(); ++i) {
    EXPECT_EQ(read.value.value[i].gyro, wrote.value[i].gyro);
    EXPECT_EQ(read.value.value[i].accel, wrote.value[i].accel);
  }
  EXPECT_NE(file_bytes(path).find("frame_readout_time,16.2\n"), std::string::npos);
}

}  // namespace
}  // namespace vispline

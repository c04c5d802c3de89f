/// Files recorded by others, read with the counts their notes state. Skipped where they are not at hand.
#include "vispline/io/io_testing.h"

namespace vispline {
namespace {

std::string data(const std::string& name) { return std::string(VISPLINE_SOURCE_DIR) + "/../shared/data/" + name; }

struct File {
  const char* name;
  std::int64_t read, kept;
  const char* time_unit;
};

#define SKIP_IF_ABSENT() \
  if (!std::filesystem::exists(data("README.md"))) GTEST_SKIP() << "no recorded data at hand"

TEST(RecordedData, Imu) {
  SKIP_IF_ABSENT();
  for (const File& file :
       {File{"trajectory_imu/tumvi_room1/imu0.csv.xz", 28122, 28122, ""},
        {"trajectory_imu/tumvi_room4/imu0.csv.xz", 22212, 22212, ""},
        {"trajectory_imu/broad/07_undisturbed_fast_rotation_B.csv.xz", 52518, 52518, "index@2000/7"},
        {"trajectory_imu/broad/16_undisturbed_fast_translation_B.csv.xz", 53392, 53392, "index@2000/7"}}) {
    const Outcome outcome = imu_outcome(data(file.name), {.time_unit = file.time_unit});
    EXPECT_EQ(outcome.codes, "") << file.name;
    EXPECT_EQ(outcome.read, file.read) << file.name;
    EXPECT_EQ(outcome.kept, file.kept) << file.name;
  }
}

TEST(RecordedData, Trajectories) {
  SKIP_IF_ABSENT();
  for (const File& file :
       {File{"trajectory_imu/tumvi_room1/mocap0.csv.xz", 16541, 16541, ""},
        {"trajectory_imu/tumvi_room4/mocap0.csv.xz", 13075, 13075, ""},
        {"trajectory_imu/broad/07_undisturbed_fast_rotation_B.csv.xz", 52518, 50924, "index@2000/7"},
        {"trajectory_imu/broad/16_undisturbed_fast_translation_B.csv.xz", 53392, 50124, "index@2000/7"},
        {"trajectory_only/rpng_table_01.csv.xz", 8156, 8156, ""},
        {"trajectory_only/tum_rgbd_fr1_xyz_groundtruth.txt.xz", 3000, 3000, ""}}) {
    const Outcome outcome = trajectory_outcome(data(file.name), {.time_unit = file.time_unit});
    EXPECT_EQ(outcome.exit, 0) << file.name << " " << outcome.message;
    EXPECT_EQ(outcome.read, file.read) << file.name;
    EXPECT_EQ(outcome.kept, file.kept) << file.name;
  }
}

TEST(RecordedData, StampsAreExact) {
  SKIP_IF_ABSENT();
  const auto room1 = read_imu(data("trajectory_imu/tumvi_room1/imu0.csv.xz"));
  EXPECT_EQ(to_ns(room1.value.time.front()), 1520530308181901469);
  EXPECT_EQ(to_ns(room1.value.time.back()), 1520530449232329469);
  EXPECT_EQ(room1.value.value.front().gyro, Vector3d(0.1045577128, -0.0792420275, 0.0178416359));
  const auto desk = read_trajectory(data("trajectory_only/tum_rgbd_fr1_xyz_groundtruth.txt.xz"));
  EXPECT_EQ(to_ns(desk.value.time.front()), 1305031098665900000);
  EXPECT_EQ(desk.value.value.front().p, Vector3d(1.3563, 0.6305, 1.6380));
}

TEST(RecordedData, BurstsAndUnitsBySuffix) {
  SKIP_IF_ABSENT();
  const auto bursts = read_imu(data("allan/mpu6050_10min/mpu6050_static_100hz.csv.xz"));
  EXPECT_EQ(bursts.counts.kept, 65067);
  EXPECT_EQ(bursts.diagnostics.counts().at("W-RATE"), 1);
  EXPECT_NEAR(bursts.value.value.front().gyro.x(), 4.77099237 * 0.017453292519943295, 1e-15);
  EXPECT_NEAR(bursts.value.value.front().accel.z(), -1.04077148 * 9.80665, 1e-14);
  EXPECT_EQ(imu_outcome(data("bags/ISAS-Walk1.bag")).codes, "W-STAMP");
}

}  // namespace
}  // namespace vispline

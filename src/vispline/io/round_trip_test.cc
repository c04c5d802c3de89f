/// read(write(x)) = x, and what becomes of a file cut at every byte.
#include <clocale>
#include <locale>

#include "vispline/files/compressor.h"
#include "vispline/io/course_files.h"
#include "vispline/io/io_testing.h"
#include "vispline/io/write.h"

namespace vispline {
namespace {

void expect_same(const ImuSignal& a, const ImuSignal& b) {
  ASSERT_EQ(a.time, b.time);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a.value[i].gyro, b.value[i].gyro);
    EXPECT_EQ(a.value[i].accel, b.value[i].accel);
  }
}

void expect_same(const Signal<Pose>& a, const Signal<Pose>& b) {
  ASSERT_EQ(a.time, b.time);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a.value[i].p, b.value[i].p);
    EXPECT_LT((a.value[i].R - b.value[i].R).norm(), 1e-14);
  }
}

Signal<GroundTruth> groundtruth_of(const Signal<Pose>& poses) {
  Numbers numbers(8);
  Signal<GroundTruth> states;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    states.push_back(poses.time[i], {poses.value[i], numbers.vector(), numbers.vector(), numbers.vector()});
  }
  return states;
}

TEST(RoundTrip, Imu) {
  const ScratchFolder folder;
  const ImuSignal imu = random_imu(3000, 1);
  for (const char* name : {"a.csv", "a.csv.gz", "a.csv.xz"}) {
    write_imu_csv(folder.path(name), imu);
    const auto result = read_imu(folder.path(name));
    EXPECT_EQ(result.format, "euroc_imu");
    EXPECT_TRUE(result.diagnostics.empty());
    expect_same(result.value, imu);
  }
}

TEST(RoundTrip, ImuInBlocksIsTheSameFile) {
  const ScratchFolder folder;
  const ImuSignal imu = random_imu(20000, 2);
  write_imu_csv(folder.path("whole"), imu);
  ImuCsvWriter writer(folder.path("blocks"));
  for (std::size_t begin = 0; begin < imu.size(); begin += 777) {
    ImuSignal block;
    for (std::size_t i = begin; i < std::min(begin + 777, imu.size()); ++i) block.push_back(imu.time[i], imu.value[i]);
    writer.write(block);
  }
  writer.publish();
  EXPECT_EQ(file_bytes(folder.path("whole")), file_bytes(folder.path("blocks")));
  EXPECT_LE(file_bytes(folder.path("whole")).size(), imu_csv_bytes(imu.size()));
}

TEST(RoundTrip, Trajectories) {
  const ScratchFolder folder;
  const Signal<Pose> poses = random_poses(1000, 3);
  write_trajectory_tum(folder.path("a.tum"), poses);
  write_trajectory_euroc(folder.path("a.csv"), poses);
  write_groundtruth_euroc(folder.path("gt.csv"), groundtruth_of(poses));
  for (const auto& [name, format] : {std::pair{"a.tum", "tum"}, {"a.csv", "mocap"}, {"gt.csv", "euroc_groundtruth"}}) {
    const auto result = read_trajectory(folder.path(name));
    EXPECT_EQ(result.format, format);
    EXPECT_TRUE(result.diagnostics.empty());
    expect_same(result.value, poses);
  }
}

TEST(RoundTrip, TumRowsAreAsEvoWantsThem) {
  const ScratchFolder folder;
  Signal<Pose> pose;
  pose.push_back(time_from_ns(1520530308181901469), {Matrix3d::Identity(), {1.5, -2, 0.1}});
  write_trajectory_tum(folder.path("a.tum"), pose);
  EXPECT_EQ(file_bytes(folder.path("a.tum")), "1520530308.181901469 1.5 -2 0.1 0 0 0 1\n");
}

TEST(RoundTrip, EurocHeader) {
  const ScratchFolder folder;
  write_imu_csv(folder.path("a.csv"), random_imu(1, 1, 7));
  const std::string text = file_bytes(folder.path("a.csv"));
  EXPECT_TRUE(
      text.starts_with("#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],a_RS_S_x [m s^-2],"
                       "a_RS_S_y [m s^-2],a_RS_S_z [m s^-2]\n7,"));
}

/// A locale that writes 1.234,5, whatever is installed.
struct DecimalComma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(RoundTrip, NoLocaleChangesANumber) {
  const ScratchFolder folder;
  const ImuSignal imu = random_imu(100, 4);
  write_imu_csv(folder.path("before.csv"), imu);
  const std::string c_before = std::setlocale(LC_ALL, nullptr);
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new DecimalComma));
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "de_DE"}) std::setlocale(LC_ALL, name);
  write_imu_csv(folder.path("a.csv"), imu);
  const auto result = read_imu(folder.path("before.csv"));
  std::locale::global(before);
  std::setlocale(LC_ALL, c_before.c_str());
  EXPECT_EQ(file_bytes(folder.path("a.csv")), file_bytes(folder.path("before.csv")));
  expect_same(result.value, imu);
}

/// Cuts `bytes` at every length: never a crash, never a code that is not an input error, and what is kept only grows.
template <class Reader>
void sweep(const std::string& name, const std::string& bytes, const Reader& reader) {
  SCOPED_TRACE(name);
  const ScratchFolder folder;
  std::int64_t kept = 0;
  for (std::size_t length = 0; length <= bytes.size(); ++length) {
    const Outcome outcome = reader(folder.write("f", bytes.substr(0, length)));
    ASSERT_TRUE(outcome.exit == 0 || outcome.exit == 3) << "cut at " << length << " " << outcome.codes;
    ASSERT_GE(outcome.kept, kept) << "cut at " << length << " " << outcome.codes << " " << outcome.message;
    kept = outcome.kept;
  }
  EXPECT_GT(kept, 0);
}

TEST(Truncation, ImuAndTrajectoryFiles) {
  const ScratchFolder folder;
  const Signal<Pose> poses = random_poses(4, 6);
  write_imu_csv(folder.path("imu"), random_imu(4, 5));
  write_trajectory_tum(folder.path("tum"), poses);
  write_trajectory_euroc(folder.path("mocap"), poses);
  write_groundtruth_euroc(folder.path("gt"), groundtruth_of(poses));
  const auto imu = [](const std::string& path) { return imu_outcome(path); };
  const auto trajectory = [](const std::string& path) { return trajectory_outcome(path); };
  sweep("imu", file_bytes(folder.path("imu")), imu);
  sweep("tum", file_bytes(folder.path("tum")), trajectory);
  sweep("mocap", file_bytes(folder.path("mocap")), trajectory);
  sweep("groundtruth", file_bytes(folder.path("gt")), trajectory);
  sweep("semicolons",
        "t;gx;gy;gz;ax;ay;az\r\n0,01;1,5;2;3;4;5,25;9,81\r\n0,02;1,5;2;3;4;5,25;9,82\r\n0,03;1,5;2;3;4;5,25;9,83", imu);
}

TEST(Truncation, CompressedFilesAreWholeOrRefused) {
  const ScratchFolder folder;
  write_imu_csv(folder.path("a.csv.gz"), random_imu(5, 7));
  sweep("gz", file_bytes(folder.path("a.csv.gz")), [](const std::string& path) { return imu_outcome(path); });
}

}  // namespace
}  // namespace vispline

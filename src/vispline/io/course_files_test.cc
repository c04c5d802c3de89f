#include "vispline/io/course_files.h"

#include <algorithm>
#include <sstream>

#include "vispline/io/course_observations.h"
#include "vispline/io/house.h"
#include "vispline/io/io_testing.h"

namespace vispline {
namespace {

CourseRecording recording_of(std::size_t imu_rows, std::size_t camera_rows) {
  Numbers numbers(9);
  CourseRecording recording;
  for (std::size_t i = 0; i < imu_rows; ++i) {
    CourseImuRow row;
    row.time = time_from_ns(5'000'000 * static_cast<std::int64_t>(i));
    row.state.R_w_b = SO3::exp<double>(numbers.vector());
    row.state.p_w = numbers.vector();
    row.state.v_w = numbers.vector();
    row.exact = {numbers.vector(), numbers.vector() + Vector3d(0, 0, 9.81)};
    row.noisy = {numbers.vector(), numbers.vector() + Vector3d(0, 0, 9.81)};
    row.gyro_bias = numbers.vector();
    row.accel_bias = numbers.vector();
    recording.imu.push_back(row);
    if (i > 0) recording.integrated_exact.push_back(row.time, row.state.T_w_b());
    if (i > 0) recording.integrated_noisy.push_back(row.time, {row.state.R_w_b, 2 * row.state.p_w});
  }
  for (std::size_t i = 0; i < camera_rows; ++i) {
    const Pose T_w_c{SO3::exp<double>(numbers.vector()), numbers.vector()};
    recording.camera.push_back(
        {time_from_ns(33'333'333 * static_cast<std::int64_t>(i)), T_w_c, {numbers.vector(), numbers.vector()}});
  }
  return recording;
}

std::vector<std::vector<double>> table(const std::string& path) {
  std::ifstream in(path);
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(in, line);) {
    std::istringstream cells(line);
    rows.emplace_back(std::istream_iterator<double>(cells), std::istream_iterator<double>());
  }
  return rows;
}

TEST(House, HasTheCoursesSegmentsAndPoints) {
  const auto segments = house_segments();
  ASSERT_EQ(segments.size(), 23u);
  EXPECT_EQ(segments[3].end_w, Vector3d(0, 10, 6.5));
  EXPECT_EQ(segments[7].start_w, Vector3d(0, 10, 0));
  EXPECT_EQ(segments[7].end_w, Vector3d(0, 0, 0));
  EXPECT_EQ(segments[12].start_w, Vector3d(0, 5, 10));
  EXPECT_EQ(segments[12].end_w, Vector3d(10, 5, 10));
  EXPECT_EQ(segments[18].end_w, Vector3d(0, 6, 0));
  EXPECT_EQ(segments[22].start_w, Vector3d(0, 2, 5));
  EXPECT_EQ(segments[22].end_w, Vector3d(0, 2, 2.5));
  const auto points = house_points();
  ASSERT_EQ(points.size(), 36u);
  EXPECT_EQ(points[0], Vector3d(0, 0, 0));
  EXPECT_EQ(points[1], Vector3d(0, 0, 6.5));
  EXPECT_EQ(points[8], Vector3d(0, 5, 10));
  EXPECT_EQ(points[18], Vector3d(0.5, 0.5, -0.5));
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(std::count(points.begin(), points.end(), points[i]), 1);
}

TEST(Observations, AreNormalisedAndInFront) {
  const Pose T_w_c{Matrix3d::Identity(), {1, 2, -4}};  // looks along z of the world
  EXPECT_EQ(course_point_observations({{3, 6, 4}, {0, 0, -5}, {0, 0, -4}}, T_w_c), "3 6 4 1 0.25 0.5\n");
  EXPECT_EQ(course_line_observations({{{3, 6, 4}, {1, 2, 0}}, {{3, 6, 4}, {1, 2, -9}}}, T_w_c), "0.25 0.5 0 0\n");
}

TEST(Camera, LooksAlongMinusXOfTheBody) {
  const Pose T_b_c = course_T_b_c();
  EXPECT_EQ(T_b_c * Vector3d(0, 0, 2), Vector3d(-2 + 0.05, 0.04, 0.03));
  EXPECT_EQ(T_b_c * Vector3d(1, 0, 0), Vector3d(0.05, -1 + 0.04, 0.03));
  EXPECT_EQ(T_b_c.R.determinant(), 1.0);
}

TEST(CourseFiles, HaveTheirRowsAndColumns) {
  const ScratchFolder folder;
  const std::string out = folder.path("course");
  const CourseRecording recording = recording_of(40, 6);
  write_course_files(out, recording);
  struct Shape {
    const char* name;
    std::size_t rows, columns;
  };
  for (const Shape& shape : {Shape{"imu_pose", 40, 14},
                             {"imu_pose_noise", 40, 14},
                             {"imu_int_pose", 39, 15},
                             {"imu_int_pose_noise", 39, 15},
                             {"cam_pose", 6, 14},
                             {"cam_pose_tum", 6, 8},
                             {"all_points", 36, 4},
                             {"velocity", 40, 4},
                             {"bias", 40, 7}}) {
    const auto rows = table(out + "/" + shape.name + ".txt");
    EXPECT_EQ(rows.size(), shape.rows) << shape.name;
    for (const auto& row : rows) EXPECT_EQ(row.size(), shape.columns) << shape.name;
  }
  for (int i = 0; i < 6; ++i) {
    for (const auto& row : table(out + "/keyframe/all_points_" + std::to_string(i) + ".txt")) EXPECT_EQ(row.size(), 6u);
    for (const auto& row : table(out + "/keyframe/all_lines_" + std::to_string(i) + ".txt")) EXPECT_EQ(row.size(), 4u);
  }
  EXPECT_FALSE(std::filesystem::exists(out + "/keyframe/all_points_6.txt"));
  EXPECT_EQ(table(out + "/velocity.txt")[3][2], recording.imu[3].state.v_w.y());
  EXPECT_EQ(table(out + "/bias.txt")[3][6], recording.imu[3].accel_bias.z());
  EXPECT_EQ(table(out + "/cam_pose.txt")[2][13], recording.camera[2].exact.accel.z());
  EXPECT_EQ(table(out + "/imu_int_pose_noise.txt")[0][14], 2 * recording.imu[1].state.p_w.z());
}

TEST(CourseFiles, AreReadBackExactlyAsImuAndAsTrajectory) {
  const ScratchFolder folder;
  const CourseRecording recording = recording_of(40, 6);
  write_course_files(folder.path("course"), recording);
  EXPECT_EQ(content_of(folder.path("course/imu_pose_noise.txt")), ContentKind::kBoth);
  const auto imu = read_imu(folder.path("course/imu_pose_noise.txt"));
  const auto poses = read_trajectory(folder.path("course/imu_pose.txt"));
  EXPECT_EQ(imu.format, "course");
  ASSERT_EQ(imu.value.size(), 40u);
  ASSERT_EQ(poses.value.size(), 40u);
  for (std::size_t i = 0; i < 40; ++i) {
    EXPECT_EQ(imu.value.time[i], recording.imu[i].time);
    EXPECT_EQ(imu.value.value[i].gyro, recording.imu[i].noisy.gyro);
    EXPECT_EQ(imu.value.value[i].accel, recording.imu[i].noisy.accel);
    EXPECT_EQ(poses.value.value[i].p, recording.imu[i].state.p_w);
    EXPECT_LT((poses.value.value[i].R - recording.imu[i].state.R_w_b).norm(), 1e-14);
  }
  const auto integrated = read_trajectory(folder.path("course/imu_int_pose_noise.txt"));
  ASSERT_EQ(integrated.value.size(), 39u);
  EXPECT_EQ(integrated.value.value[0].p, 2 * recording.imu[1].state.p_w);
  EXPECT_EQ(read_trajectory(folder.path("course/cam_pose_tum.txt")).value.value[5].p, recording.camera[5].T_w_c.p);
}

TEST(CourseFiles, AreNotMixedWithOlderOnes) {
  const ScratchFolder folder;
  write_course_files(folder.path("course"), recording_of(10, 3));
  EXPECT_THROW(write_course_files(folder.path("course"), recording_of(10, 3)), Error);
  EXPECT_NO_THROW(write_course_files(folder.path("course"), recording_of(10, 3), {.force = true}));
  EXPECT_THROW(write_course_files(folder.path("course"), recording_of(10, 2), {.force = true}), Error);
}

}  // namespace
}  // namespace vispline

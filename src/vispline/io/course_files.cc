#include "vispline/io/course_files.h"

#include <filesystem>

#include "vispline/core/error.h"
#include "vispline/io/course_observations.h"
#include "vispline/io/course_pose.h"
#include "vispline/io/format_words.h"
#include "vispline/io/house.h"
#include "vispline/io/tum.h"

namespace vispline {
namespace {

constexpr std::string_view kReadme = R"(Files of a simulated recording, in the layout of vio_data_simulation.
No header lines; one blank between numbers; shortest digits that read back to the same double.
Frames: w world, z up; b body = IMU; c camera. Gravity points down. Quaternions are Hamilton, body to world.

imu_pose.txt            t[s] qw qx qy qz px py pz[m] wx wy wz[rad/s] ax ay az[m/s^2]: T_w_b and the exact IMU reading
imu_pose_noise.txt      the same poses with the noisy reading
imu_int_pose.txt        t qw qx qy qz px py pz, and the same pose again: dead reckoning of the exact reading
imu_int_pose_noise.txt  the same for the noisy reading; both start at the second sample
cam_pose.txt            t qw qx qy qz px py pz wx wy wz ax ay az: T_w_c and the exact IMU reading (frame b) at that instant
cam_pose_tum.txt        t px py pz qx qy qz qw: T_w_c, TUM order
all_points.txt          X Y Z 1 [m]: the points of the scene, world
keyframe/all_points_<n>.txt  X Y Z 1 u v: point and normalised image coordinates x/z, y/z in camera pose n (from 0)
keyframe/all_lines_<n>.txt   u1 v1 u2 v2: normalised ends of the edges of the scene
velocity.txt            t[s] vx vy vz[m/s]: velocity of the body, world
bias.txt                t[s] bgx bgy bgz[rad/s] bax bay baz[m/s^2]: true biases in the noisy reading
)";

/// One row: the time, whatever `append` adds, a line end.
template <class Append>
void append_row(std::string& out, Time time, const Append& append) {
  append_short_seconds(out, time);
  append();
  out += '\n';
}

void append_reading(std::string& out, const ImuSample& sample) {
  append_cells(out, ' ', sample.gyro);
  append_cells(out, ' ', sample.accel);
}

/// imu_pose.txt, or imu_pose_noise.txt for `&CourseImuRow::noisy`.
std::string imu_pose_text(const std::vector<CourseImuRow>& rows, ImuSample CourseImuRow::*reading) {
  std::string out;
  for (const CourseImuRow& row : rows) {
    append_row(out, row.time, [&] {
      course_pose::append_pose(out, row.state.T_w_b());
      append_reading(out, row.*reading);
    });
  }
  return out;
}

std::string integrated_text(const Signal<Pose>& T_w_b) {
  std::string out;
  for (std::size_t i = 0; i < T_w_b.size(); ++i) {
    append_row(out, T_w_b.time[i], [&] {
      course_pose::append_pose(out, T_w_b.value[i]);
      course_pose::append_pose(out, T_w_b.value[i]);
    });
  }
  return out;
}

std::string camera_text(const std::vector<CourseCameraRow>& rows) {
  std::string out;
  for (const CourseCameraRow& row : rows) {
    append_row(out, row.time, [&] {
      course_pose::append_pose(out, row.T_w_c);
      append_reading(out, row.exact);
    });
  }
  return out;
}

std::string camera_tum_text(const std::vector<CourseCameraRow>& rows) {
  std::string out;
  for (const CourseCameraRow& row : rows) tum::append_row(out, row.time, row.T_w_c);
  return out;
}

std::string velocity_text(const std::vector<CourseImuRow>& rows) {
  std::string out;
  for (const CourseImuRow& row : rows) {
    append_row(out, row.time, [&] { append_cells(out, ' ', row.state.v_w); });
  }
  return out;
}

std::string bias_text(const std::vector<CourseImuRow>& rows) {
  std::string out;
  for (const CourseImuRow& row : rows) {
    append_row(out, row.time, [&] {
      append_cells(out, ' ', row.gyro_bias);
      append_cells(out, ' ', row.accel_bias);
    });
  }
  return out;
}

std::string keyframe_name(const std::string& folder, const char* what, std::size_t index) {
  return folder + "/keyframe/" + what + "_" + std::to_string(index) + ".txt";
}

/// Observations of an older, longer recording would stay among the new ones.
void refuse_leftovers(const std::string& folder, std::size_t keyframes) {
  const std::string next = keyframe_name(folder, "all_points", keyframes);
  std::error_code error;
  if (!std::filesystem::exists(next, error)) return;
  throw Error(ExitCode::kOutput, {.code = "E-OUTPUT",
                                  .message = "the folder holds the keyframes of a longer recording",
                                  .where = next,
                                  .effect = "nothing written",
                                  .next = "name an empty folder"});
}

void write_keyframes(const std::string& folder, const CourseRecording& recording, OutputOptions options) {
  for (std::size_t i = 0; i < recording.camera.size(); ++i) {
    const Pose& T_w_c = recording.camera[i].T_w_c;
    write_file(keyframe_name(folder, "all_points", i), course_point_observations(recording.points_w, T_w_c), options);
    write_file(keyframe_name(folder, "all_lines", i), course_line_observations(recording.segments_w, T_w_c), options);
  }
}

}  // namespace

std::string course_camera_notes() {
  return "Camera: R_b_c = [0 0 -1; -1 0 0; 0 1 0], p_b_c = (0.05, 0.04, 0.03) m.\n"
         "For pixels: fx = fy = 460, cx = cy = 255, image 640 x 640; no distortion. Nothing is cut at the image "
         "border.\n";
}

Pose course_T_b_c() {
  Pose T_b_c;
  T_b_c.R << 0, 0, -1, -1, 0, 0, 0, 1, 0;
  T_b_c.p << 0.05, 0.04, 0.03;
  return T_b_c;
}

void write_course_files(const std::string& folder, const CourseRecording& recording, OutputOptions options) {
  refuse_leftovers(folder, recording.camera.size());
  OutputOptions part = options;
  part.sync = false;
  write_keyframes(folder, recording, part);
  const auto write = [&](const char* name, const std::string& text) { write_file(folder + "/" + name, text, options); };
  write("imu_pose.txt", imu_pose_text(recording.imu, &CourseImuRow::exact));
  write("imu_pose_noise.txt", imu_pose_text(recording.imu, &CourseImuRow::noisy));
  write("imu_int_pose.txt", integrated_text(recording.integrated_exact));
  write("imu_int_pose_noise.txt", integrated_text(recording.integrated_noisy));
  write("cam_pose.txt", camera_text(recording.camera));
  write("cam_pose_tum.txt", camera_tum_text(recording.camera));
  write("all_points.txt", course_point_list(recording.points_w));
  write("velocity.txt", velocity_text(recording.imu));
  write("bias.txt", bias_text(recording.imu));
  write("README.txt", std::string(kReadme) + "\n" + recording.camera_notes +
                          (recording.notes.empty() ? "" : "\n" + recording.notes + "\n"));
}

}  // namespace vispline

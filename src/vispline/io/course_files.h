/// The folder of text files that the course simulator writes, with all digits and the right number of rows, and what it
/// never wrote: velocities, true biases, the meaning of the columns. docs/formats.md, Course files.
#pragma once

#include <string>
#include <vector>

#include "vispline/core/body_state.h"
#include "vispline/core/pose.h"
#include "vispline/core/signal.h"
#include "vispline/files/output_file.h"
#include "vispline/io/house.h"
#include "vispline/sensors/recording.h"

namespace vispline {

/// One instant of the IMU. The IMU is the body frame.
struct CourseImuRow {
  Time time;
  BodyState state;
  ImuSample exact;
  ImuSample noisy;
  Vector3d gyro_bias = Vector3d::Zero();   ///< rad/s, part of `noisy`
  Vector3d accel_bias = Vector3d::Zero();  ///< m/s^2, part of `noisy`
};

/// One instant of the camera.
struct CourseCameraRow {
  Time time;
  Pose T_w_c;
  ImuSample exact;  ///< what an exact IMU reads at this instant, frame b
};

/// What README.txt says of the course's own camera.
std::string course_camera_notes();

struct CourseRecording {
  std::vector<CourseImuRow> imu;
  Signal<Pose> integrated_exact;  ///< T_w_b by dead reckoning of `exact`, from the second sample on
  Signal<Pose> integrated_noisy;
  std::vector<CourseCameraRow> camera;
  std::vector<Vector3d> points_w = house_points();
  std::vector<Segment> segments_w = house_segments();
  std::string camera_notes = course_camera_notes();
  std::string notes;  ///< a line or more for README.txt: trajectory, noise, seed
};

/// The camera in the body: x_c = -y_b, y_c = z_b, z_c = -x_b; at (0.05, 0.04, 0.03) m.
Pose course_T_b_c();

/// Writes the whole set into `folder`, README.txt last: without it the set is not complete. Throws E-OUTPUT.
void write_course_files(const std::string& folder, const CourseRecording& recording, OutputOptions options = {});

}  // namespace vispline

/// The course's text files of one IMU and one camera with a global shutter.
#pragma once

#include <string>
#include <vector>

#include "vispline/files/output_file.h"
#include "vispline/io/course_files.h"
#include "vispline/simulate/imu_simulation.h"

namespace vispline::cli {

struct CourseTask {
  Trajectory trajectory;
  ImuSimulation imu{};
  const Stamps& stamps;
  std::vector<Time> images{};  ///< on the clock of the body; those outside the trajectory end the list
  Pose T_b_c{};
  std::string folder{};
  std::vector<Vector3d> points_w = house_points();
  std::vector<Segment> segments_w = house_segments();
  std::string camera_notes = course_camera_notes();
};

void write_course(const CourseTask& task, OutputOptions options);

}  // namespace vispline::cli

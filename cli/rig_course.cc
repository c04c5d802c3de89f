#include "rig_course.h"

#include "course_output.h"
#include "vispline/results/table.h"
#include "vispline/simulate/camera_frames.h"

namespace vispline::cli {
namespace {

std::string camera_notes(const Camera& camera) {
  std::string text = "Camera: T_b_c, row by row:";
  const Pose T_b_c = camera.T_c_b.inverse();
  for (int row = 0; row < 3; ++row) {
    text += " [" + number_text(T_b_c.R(row, 0), 9) + " " + number_text(T_b_c.R(row, 1), 9) + " " +
            number_text(T_b_c.R(row, 2), 9) + " " + number_text(T_b_c.p[row], 9) + "]";
  }
  return text + ".\nNothing is cut at the image border. Lens and noise: rig.yaml.\n";
}

}  // namespace

void require_course(const Rig& rig) {
  require(!rig.imus.empty() && !rig.cameras.empty(), "an IMU and a camera for the course's files");
  require(rig.cameras[0].shutter.line_delay_s == 0.0, "a global shutter for the course's files");
}

void write_rig_course(const RigTask& task, const RigInputs& all, OutputOptions options) {
  const Rig& rig = all.document.rig;
  const Camera& camera = rig.cameras[0];
  const Stamps stamps = imu_stamps(all, rig.imus[0]);
  CourseTask course{.trajectory = all.source.trajectory,
                    .imu = imu_simulation(task, all, rig.imus[0]),
                    .stamps = stamps,
                    .T_b_c = camera.T_c_b.inverse(),
                    .folder = task.out + "/course",
                    .points_w = {},
                    .camera_notes = camera_notes(camera)};
  if (task.flags.scene != "house") course.segments_w.clear();
  for (const SceneLandmark& landmark : all.scene.scene.landmarks) course.points_w.push_back(landmark.point_w);
  CameraFrames frames({camera}, all.document.clocks, all.start, all.duration);
  while (const auto frame = frames.next()) {
    course.images.push_back(frame->stamp + from_seconds(frame->clock_delay_s + camera.time_offset_s));
  }
  write_course(course, options);
}

}  // namespace vispline::cli

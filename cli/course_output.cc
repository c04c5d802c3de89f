#include "course_output.h"

#include "console.h"
#include "vispline/integrate/dead_reckon.h"

namespace vispline::cli {
namespace {

constexpr const char* kRule = "euler_course";

/// Dead reckoning as the course does it, from the second sample on.
Signal<Pose> integrated(const SimulatedImu& samples, const ImuSignal& imu, const Vector3d& g_w) {
  Signal<Pose> poses_w = poses(dead_reckon(imu, nav_state(samples.body.value.front()), kRule, g_w));
  poses_w.time.erase(poses_w.time.begin());
  poses_w.value.erase(poses_w.value.begin());
  return poses_w;
}

std::vector<CourseCameraRow> camera_rows(const CourseTask& task) {
  std::vector<CourseCameraRow> rows;
  const ImuSimulation& imu = task.imu;
  for (const Time time : task.images) {
    const auto state = task.trajectory.at(time);
    if (!state) break;
    rows.push_back({time,
                    state->T_w_b() * task.T_b_c,
                    {Gyroscope::predict(*state, imu.imu.gyroscope, imu.g_w),
                     Accelerometer::predict(*state, imu.imu.accelerometer, imu.g_w)}});
  }
  return rows;
}

}  // namespace

void write_course(const CourseTask& task, OutputOptions options) {
  const SimulatedImu samples = simulate_imu(task.trajectory, task.imu, task.stamps);
  CourseRecording recording;
  const ImuSignal exact{samples.measured.time, samples.exact};
  for (std::size_t i = 0; i < exact.size(); ++i) {
    recording.imu.push_back({exact.time[i], samples.body.value[i], samples.exact[i], samples.measured.value[i],
                             samples.bias[i].gyro, samples.bias[i].accel});
  }
  recording.integrated_exact = integrated(samples, exact, task.imu.g_w);
  recording.integrated_noisy = integrated(samples, samples.measured, task.imu.g_w);
  recording.camera = camera_rows(task);
  recording.points_w = task.points_w;
  recording.segments_w = task.segments_w;
  recording.camera_notes = task.camera_notes;
  recording.notes = "imu_int_pose.txt is dead reckoning by the rule " + std::string(kRule) +
                    ".\nSeed of the noise: " + std::to_string(task.imu.seed) + ".\n";
  const OutputGuard guard;
  write_course_files(task.folder, recording, options);
}

}  // namespace vispline::cli

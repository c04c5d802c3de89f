#include "simulate_output.h"

#include <filesystem>

#include "console.h"
#include "vispline/integrate/dead_reckon.h"
#include "vispline/io/course_files.h"
#include "vispline/io/write.h"

namespace vispline::cli {
namespace {

const std::string kEurocTruth = "/mav0/state_groundtruth_estimate0/data.csv";
constexpr double kCourseCameraRate_hz = 30.0;
constexpr const char* kCourseRule = "euler_course";

std::string euroc_imu(const std::string& out, const std::string& imu) { return out + "/mav0/" + imu + "/data.csv"; }

bool same_name(const std::string& a, const std::string& b) {
  return !a.empty() && !b.empty() &&
         std::filesystem::absolute(a).lexically_normal() == std::filesystem::absolute(b).lexically_normal();
}

/// Free space that the samples need; unknown if they are compressed.
std::uint64_t bytes_needed(const std::string& path, std::size_t samples) {
  return path.ends_with(".gz") || path.ends_with(".xz") ? 0 : imu_csv_bytes(samples);
}

void append_truth(const SimulatedImu& block, Signal<GroundTruth>& truth) {
  for (std::size_t i = 0; i < block.body.size(); ++i) {
    const BodyState& state = block.body.value[i];
    truth.push_back(block.body.time[i], {state.T_w_b(), state.v_w, block.bias[i].gyro, block.bias[i].accel});
  }
}

/// Streams one IMU into a CSV, block by block; collects the truth if asked to.
void write_imu(const SimulationTask& task, const ImuSimulation& imu, const std::string& path,
               Signal<GroundTruth>* truth) {
  probe_output(path, bytes_needed(path, task.stamps.size()), task.output);
  const OutputGuard guard;
  ImuCsvWriter writer(path, task.output);
  Progress progress(imu.imu.name, task.stamps.size());
  simulate_imu(task.trajectory, imu, task.stamps, [&](const SimulatedImu& block) {
    writer.write(block.measured);
    if (truth != nullptr) append_truth(block, *truth);
    progress.add(block.measured.size());
  });
  writer.publish();
}

void write_csv(const SimulationTask& task) {
  Signal<GroundTruth> truth;
  write_imu(task, task.imus[0], task.out, task.truth.empty() ? nullptr : &truth);
  const OutputGuard guard;
  if (!task.truth.empty()) write_groundtruth_euroc(task.truth, truth, task.output);
}

void write_euroc(const SimulationTask& task) {
  Signal<GroundTruth> truth;
  for (std::size_t i = 0; i < task.imus.size(); ++i) {
    write_imu(task, task.imus[i], euroc_imu(task.out, task.imus[i].imu.name), i == 0 ? &truth : nullptr);
  }
  const OutputGuard guard;
  write_groundtruth_euroc(task.out + kEurocTruth, truth, task.output);
}

/// Dead reckoning as the course does it, from the second sample on.
Signal<Pose> course_integration(const SimulatedImu& samples, const ImuSignal& imu, const Vector3d& g_w) {
  Signal<Pose> integrated = poses(dead_reckon(imu, nav_state(samples.body.value.front()), kCourseRule, g_w));
  integrated.time.erase(integrated.time.begin());
  integrated.value.erase(integrated.value.begin());
  return integrated;
}

std::vector<CourseCameraRow> course_camera(const SimulationTask& task) {
  const Time begin = task.stamps[0];
  const Duration length = task.stamps[task.stamps.size() - 1] - begin + from_seconds(task.stamps.period());
  const Stamps stamps({begin, kCourseCameraRate_hz}, length);
  std::vector<CourseCameraRow> rows;
  const ImuSimulation& imu = task.imus[0];
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    const auto state = task.trajectory.at(stamps[i]);
    if (!state) break;
    rows.push_back({stamps[i],
                    state->T_w_b() * course_T_b_c(),
                    {Gyroscope::predict(*state, imu.imu.gyroscope, imu.g_w),
                     Accelerometer::predict(*state, imu.imu.accelerometer, imu.g_w)}});
  }
  return rows;
}

void write_course(const SimulationTask& task) {
  const ImuSimulation& imu = task.imus[0];
  const SimulatedImu samples = simulate_imu(task.trajectory, imu, task.stamps);
  CourseRecording recording;
  ImuSignal exact{samples.measured.time, samples.exact};
  for (std::size_t i = 0; i < exact.size(); ++i) {
    recording.imu.push_back({exact.time[i], samples.body.value[i], samples.exact[i], samples.measured.value[i],
                             samples.bias[i].gyro, samples.bias[i].accel});
  }
  recording.integrated_exact = course_integration(samples, exact, imu.g_w);
  recording.integrated_noisy = course_integration(samples, samples.measured, imu.g_w);
  recording.camera = course_camera(task);
  recording.notes = "imu_int_pose.txt is dead reckoning by the rule " + std::string(kCourseRule) +
                    ".\nSeed of the noise: " + std::to_string(imu.seed) + ".\n";
  const OutputGuard guard;
  write_course_files(task.out, recording, task.output);
}

}  // namespace

void probe_simulation(const SimulationNames& names, const OutputOptions& options) {
  std::vector<std::string> paths;
  if (names.format == "csv") {
    paths = {names.out};
    if (!names.truth.empty()) paths.push_back(names.truth);
  } else if (names.format == "euroc") {
    for (std::size_t i = 0; i < names.imus; ++i) paths.push_back(euroc_imu(names.out, "imu" + std::to_string(i)));
    paths.push_back(names.out + kEurocTruth);
  } else {
    paths = {names.out + "/README.txt"};
  }
  require(!same_name(names.out, names.truth), "two names for --out and --truth");
  for (const std::string& path : paths) probe_output(path, 0, options);
}

void write_simulation(const SimulationTask& task, const std::string& format) {
  if (format == "csv") return write_csv(task);
  if (format == "euroc") return write_euroc(task);
  write_course(task);
}

}  // namespace vispline::cli

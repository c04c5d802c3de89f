#include "simulate_output.h"

#include <filesystem>

#include "console.h"
#include "course_output.h"
#include "vispline/io/course_files.h"
#include "vispline/io/write.h"

namespace vispline::cli {
namespace {

const std::string kEurocTruth = "/mav0/state_groundtruth_estimate0/data.csv";
constexpr double kCourseCameraRate_hz = 30.0;

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

void write_course_folder(const SimulationTask& task) {
  const Time begin = task.stamps[0];
  const Duration length = task.stamps[task.stamps.size() - 1] - begin + from_seconds(task.stamps.period());
  const Stamps images({begin, kCourseCameraRate_hz}, length);
  std::vector<Time> times;
  for (std::size_t i = 0; i < images.size(); ++i) times.push_back(images[i]);
  cli::write_course({.trajectory = task.trajectory,
                     .imu = task.imus[0],
                     .stamps = task.stamps,
                     .images = times,
                     .T_b_c = course_T_b_c(),
                     .folder = task.out},
                    task.output);
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
  write_course_folder(task);
}

}  // namespace vispline::cli

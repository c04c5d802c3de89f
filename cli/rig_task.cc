#include "rig_task.h"

#include <sstream>

#include "vispline/core/parallel.h"
#include "vispline/io/rig_file.h"
#include "vispline/io/rig_presets.h"

namespace vispline::cli {
namespace {

/// An analytic motion goes on for so long behind the last stamp, so that time offsets and readouts lose no sample.
constexpr double kTail_s = 1.0;

RigDocument load_rig(const std::string& names, Session& session) {
  if (auto preset = rig_preset(names)) return *preset;
  std::vector<std::string> paths;
  std::istringstream list(names);
  for (std::string path; std::getline(list, path, ',');) paths.push_back(path);
  ReadRig read = read_rig(paths);
  session.add(read.diagnostics);
  return {read.rig, read.g_w, read.estimate, read.clocks};
}

TrajectorySource load_motion(TrajectoryFlags flags, const ReadFlags& read, Session& session) {
  flags.duration_s = flags.duration_s.value_or(20.0) + kTail_s;
  return load_trajectory(flags, read, session);
}

}  // namespace

RigInputs load_inputs(const RigTask& task, Session& session) {
  RigInputs all{.document = load_rig(task.flags.rig, session),
                .source = load_motion(task.trajectory, task.read, session)};
  const TimeSpan span = all.source.trajectory.span();
  all.start = task.trajectory.start_s ? Time{} + from_seconds(*task.trajectory.start_s) : span.begin;
  const Duration rest =
      all.source.fit ? Duration(span.end - all.start) : Duration(span.end - all.start) - from_seconds(kTail_s);
  all.duration = task.trajectory.duration_s ? from_seconds(*task.trajectory.duration_s) : rest;
  require(all.duration > Duration::zero(), "a start before the end of the trajectory");
  all.scene = load_scene({.name = task.flags.scene,
                          .trajectory = all.source.trajectory,
                          .rig = all.document.rig,
                          .span = {all.start, all.start + all.duration},
                          .landmarks = task.flags.landmarks,
                          .seed = task.seed},
                         session);
  return all;
}

std::size_t threads_of(const RigTask& task) { return task.threads == 0 ? hardware_threads() : task.threads; }

Stamps imu_stamps(const RigInputs& all, const Imu& imu) {
  const Duration phase = from_seconds(clock_of(all.document.clocks, imu.name).phase_s);
  require(phase < all.duration, "a duration longer than the phases of the sensors");
  return Stamps({all.start + phase, imu.rate_hz}, all.duration - phase);
}

ImuSimulation imu_simulation(const RigTask& task, const RigInputs& all, const Imu& imu) {
  return {.imu = imu,
          .g_w = all.document.g_w,
          .seed = task.seed,
          .threads = threads_of(task),
          .outside = OutsideSpan::kSkip,
          .clock_drift = clock_of(all.document.clocks, imu.name).drift,
          .clock_start = all.start};
}

}  // namespace vispline::cli

// vispline estimate: an IMU with feature tracks or with poses from outside in; trajectory, points and the whole rig
// out.
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "estimation_output.h"
#include "process_memory.h"
#include "result_folder.h"
#include "verbs.h"
#include "vispline/estimate/knot_spacing.h"
#include "vispline/estimate/pose_estimation.h"
#include "vispline/estimate/track_estimation.h"
#include "vispline/io/features.h"

namespace vispline::cli {
namespace {

struct EstimateFlags : EstimationFlags {
  std::string poses, landmarks = "point";
  std::vector<std::string> tracks;
};

/// What `vispline simulate --rig` writes beside the IMU.
std::vector<std::string> tracks_beside(const std::string& recording, const Rig& rig) {
  std::vector<std::string> found;
  for (const Camera& camera : rig.cameras) {
    const std::string path = recording + "/tracks_" + camera.name + ".csv";
    if (std::filesystem::is_regular_file(path)) found.push_back(camera.name + "=" + path);
  }
  return found;
}

Estimation from_poses(EstimateFlags& flags, const RigDocument& start, const Recording& recording,
                      const Signal<Pose>& poses, double spacing_s) {
  PoseEstimationOptions options;
  options.curve = flags.curve(spacing_s);
  options.gravity = flags.gravity_of(start);
  options.treatments = flags.treatments(start);
  options.huber_sigmas = flags.huber;
  options.trust_noise = flags.noise == "rig";
  options.bias_walk = flags.bias_walk();
  options.solve = flags.solve_options();
  return estimate_with_poses(start.rig, recording.imus.at(start.rig.imus.front().name), poses, options);
}

Estimation from_tracks(EstimateFlags& flags, const RigDocument& start, const Recording& recording, double spacing_s) {
  TrackEstimationOptions options;
  options.curve = flags.curve(spacing_s);
  options.unknowns = flags.landmarks == "point" ? LandmarkUnknowns::kPoint : LandmarkUnknowns::kInverseDepth;
  options.gravity = flags.gravity_of(start);
  options.treatments = flags.treatments(start);
  options.huber_sigmas = flags.huber;
  options.trust_noise = flags.noise == "rig";
  options.bias_walk = flags.bias_walk();
  options.solve = flags.solve_options();
  return estimate_with_tracks(start.rig, recording, options);
}

void read_tracks_of(EstimateFlags& flags, const Rig& rig, Recording& recording) {
  if (flags.tracks.empty()) flags.tracks = tracks_beside(flags.recording, rig);
  if (flags.tracks.empty()) {
    throw Error(ExitCode::kUsage, {"E-ARGUMENT", "neither poses nor tracks are given", flags.recording,
                                   "nothing estimated", "pass --poses FILE, or --landmarks CAM=TRACKS and --rig"});
  }
  for (const std::string& argument : flags.tracks) {
    const auto [camera, file] = camera_and_file(argument, rig);
    auto features = read_features(file, flags.read.options(1, flags.session));
    flags.session.add_input(camera, features.counts, features.diagnostics);
    recording.features[camera] = std::move(features.value);
  }
}

void run(EstimateFlags& flags) {
  keep_freed_memory();
  probe_result_folder(flags.out, output_options(flags.session));
  const RigDocument start = flags.load_rig();
  Recording recording;
  flags.read_imus(start.rig, recording);
  const KnotSpacingChoice spacing = choose_knot_spacing(recording.imus.at(start.rig.imus.front().name), flags.order);
  Signal<Pose> poses;
  if (!flags.poses.empty()) {
    auto read = read_trajectory(flags.poses, flags.read.options(1, flags.session));
    flags.session.add_input("poses", read.counts, read.diagnostics);
    poses = std::move(read.value);
  } else {
    read_tracks_of(flags, start.rig, recording);
  }
  std::optional<OutputGuard> interrupts_end_the_iterations(std::in_place);
  const Estimation estimation = poses.empty() ? from_tracks(flags, start, recording, spacing.spacing_s)
                                              : from_poses(flags, start, recording, poses, spacing.spacing_s);
  if (!flags.interrupted()) interrupts_end_the_iterations.reset();
  finish_estimation(flags, estimation, start, flags.spacing == "auto" ? spacing.why : "as asked for");
}

}  // namespace

void add_estimate(CLI::App& app) {
  auto flags = std::make_shared<EstimateFlags>();
  CLI::App* verb =
      app.add_subcommand("estimate", "trajectory and rig by Spline Fusion, from an IMU and tracks or poses");
  flags->add_to(*verb);
  verb->add_option("--landmarks", flags->tracks,
                   "CAM=FILE: feature tracks of unknown points; default: RECORDING/tracks_CAM.csv");
  verb->add_option("--poses", flags->poses, "poses from outside: motion capture");
  verb->add_option("--landmark-unknowns", flags->landmarks, "point: three; inverse-depth: the paper's one")
      ->check(CLI::IsMember({"point", "inverse-depth"}));
  verb->callback([flags] { run(*flags); });
}

}  // namespace vispline::cli

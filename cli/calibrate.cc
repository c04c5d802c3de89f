// vispline calibrate: corners of a known target and an IMU in, the whole rig out.
#include "vispline/estimate/calibrate.h"

#include <memory>
#include <optional>

#include "estimation_output.h"
#include "process_memory.h"
#include "result_folder.h"
#include "rig_scene.h"
#include "verbs.h"
#include "vispline/estimate/knot_spacing.h"
#include "vispline/io/features.h"

namespace vispline::cli {
namespace {

struct CalibrateFlags : EstimationFlags {
  std::string target;
  std::vector<std::string> corners;
};

/// A board by its description, or any points by their ids.
TargetPoints read_target(const std::string& path, CalibrateFlags& flags) {
  if (path.ends_with(".yaml") || path.ends_with(".yml") || path.ends_with(".json")) {
    const TargetReading board = read_target_file(path);
    flags.session.add(board.diagnostics);
    TargetPoints points;
    for (const SceneLandmark& landmark : scene_of(board.target, Pose{}).landmarks)
      points[landmark.id] = landmark.point_w;
    return points;
  }
  auto points = read_points(path, flags.read.options(1, flags.session));
  flags.session.add_input("target", points.counts, points.diagnostics);
  return points.value;
}

void run(CalibrateFlags& flags) {
  keep_freed_memory();
  require(!flags.rig.empty(), "--rig with the start values");
  probe_result_folder(flags.out, output_options(flags.session));
  const RigDocument start = flags.load_rig();
  Recording recording;
  flags.read_imus(start.rig, recording);
  for (const std::string& argument : flags.corners) {
    const auto [camera, file] = camera_and_file(argument, start.rig);
    auto features = read_features(file, flags.read.options(1, flags.session));
    flags.session.add_input(camera, features.counts, features.diagnostics);
    recording.features[camera] = std::move(features.value);
  }
  const TargetPoints target = read_target(flags.target, flags);
  const KnotSpacingChoice spacing = choose_knot_spacing(recording.imus.at(start.rig.imus.front().name), flags.order);
  CalibrateOptions options;
  options.curve = flags.curve(spacing.spacing_s);
  options.gravity = flags.gravity_of(start);
  options.treatments = flags.treatments(start);
  options.huber_sigmas = flags.huber;
  options.trust_noise = flags.noise == "rig";
  options.bias_walk = flags.bias_walk();
  options.solve = flags.solve_options();
  std::optional<OutputGuard> interrupts_end_the_iterations(std::in_place);
  const Estimation estimation = calibrate(start.rig, recording, target, options);
  if (!flags.interrupted()) interrupts_end_the_iterations.reset();
  finish_estimation(flags, estimation, start, flags.spacing == "auto" ? spacing.why : "as asked for");
}

}  // namespace

void add_calibrate(CLI::App& app) {
  auto flags = std::make_shared<CalibrateFlags>();
  CLI::App* verb = app.add_subcommand("calibrate", "cameras and IMUs against a known target, rolling shutter included");
  flags->add_to(*verb);
  verb->add_option("--target", flags->target, "points `id,x,y,z`, or a target file of Kalibr")->required();
  verb->add_option("--corners", flags->corners, "CAM=FILE: corners of the target in the images of a camera")
      ->required();
  verb->callback([flags] { run(*flags); });
}

}  // namespace vispline::cli

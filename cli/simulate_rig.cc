#include "simulate_rig.h"

#include <iostream>
#include <memory>

#include "bag_output.h"
#include "image_output.h"
#include "rig_course.h"
#include "rig_output.h"
#include "vispline/results/table.h"

namespace vispline::cli {
namespace {

struct Counts {
  std::size_t imu_samples = 0;
  std::size_t imu_outside = 0;
  FeatureCounts features{};
  std::size_t images = 0;
  std::size_t images_outside = 0;
};

using Bags = std::vector<std::unique_ptr<BagOutput>>;

Bags bag_outputs(const RigTask& task, const Rig& rig, OutputOptions options) {
  Bags bags;
  for (const char* name : {"bag", "mcap", "rosbag2"}) {
    if (!task.flags.wants(name)) continue;
    bags.push_back(std::make_unique<BagOutput>(name, task.out, rig, task.flags.images, options.force));
  }
  return bags;
}

void write_imu(const RigTask& task, const RigInputs& all, std::size_t index, OutputOptions options, Bags& bags,
               Counts& counts) {
  const Imu& imu = all.document.rig.imus[index];
  const Stamps stamps = imu_stamps(all, imu);
  const ImuSimulation simulation = imu_simulation(task, all, imu);
  ImuOutput output(task.out, imu, index == 0, options);
  Progress progress(imu.name, stamps.size());
  counts.imu_outside += simulate_imu(all.source.trajectory, simulation, stamps, [&](const SimulatedImu& block) {
    output.write(block);
    for (const auto& bag : bags) bag->write(index, block);
    counts.imu_samples += block.measured.size();
    progress.add(block.measured.size());
  });
  output.publish();
}

/// One for each camera; none without --images.
std::vector<ImageOutput> image_outputs(const RigTask& task, const RigInputs& all, OutputOptions options) {
  std::vector<ImageOutput> outputs;
  if (!task.flags.images) return outputs;
  RenderOptions render = task.flags.render;
  render.seed = task.seed;
  render.threads = threads_of(task);
  for (const Camera& camera : all.document.rig.cameras) {
    outputs.emplace_back(task.out, all.scene.scene, camera, render, options);
  }
  return outputs;
}

void write_cameras(const RigTask& task, const RigInputs& all, OutputOptions options, Bags& bags, Counts& counts) {
  const Rig& rig = all.document.rig;
  if (rig.cameras.empty()) return;
  FeatureSimulation simulation = task.flags.features;
  simulation.tracks.is_target = all.scene.target.has_value();
  simulation.clocks = all.document.clocks;
  simulation.seed = task.seed;
  simulation.threads = threads_of(task);
  const std::size_t target_points = all.scene.target ? all.scene.scene.landmarks.size() : 0;
  std::vector<CameraOutput> outputs;
  for (const Camera& camera : rig.cameras) outputs.emplace_back(task.out, camera, target_points, options);
  std::vector<ImageOutput> images = image_outputs(task, all, options);
  Progress progress("images", CameraFrames(rig.cameras, simulation.clocks, all.start, all.duration).size());
  const auto take = [&](const SimulatedFrame& frame) {
    const std::size_t camera = frame.instant.camera;
    outputs[camera].write(frame);
    if (task.flags.images) {
      const auto image = images[camera].write(all.source.trajectory, frame.instant);
      for (const auto& bag : bags) {
        if (image) bag->write(camera, frame.instant.stamp, *image);
      }
      counts.images += image.has_value();
    }
    progress.add(1);
  };
  counts.features =
      simulate_features(all.source.trajectory, rig, all.scene.scene, all.start, all.duration, simulation, take);
  for (CameraOutput& output : outputs) output.publish();
  for (ImageOutput& output : images) {
    output.publish();
    counts.images_outside += output.outside();
  }
}

void warn(Session& session, std::size_t count, const char* code, const std::string& what, const std::string& effect) {
  if (count == 0) return;
  session.add({.code = code, .message = std::to_string(count) + what, .where = "", .effect = effect, .next = ""});
}

void print_summary(const RigTask& task, const RigInputs& all, const Counts& counts, const Session& session) {
  const Rig& rig = all.document.rig;
  if (session.json) {
    JsonObject document = begin_document("vispline.simulate_rig/1", session.context);
    document.set("imus", static_cast<std::int64_t>(rig.imus.size()))
        .set("samples", static_cast<std::int64_t>(counts.imu_samples))
        .set("cameras", static_cast<std::int64_t>(rig.cameras.size()))
        .set("frames", static_cast<std::int64_t>(counts.features.frames))
        .set("images", static_cast<std::int64_t>(counts.images))
        .set("features", static_cast<std::int64_t>(counts.features.features))
        .set("displaced_features", static_cast<std::int64_t>(counts.features.outliers))
        .set("landmarks", static_cast<std::int64_t>(all.scene.scene.landmarks.size()))
        .set("begin_s", to_seconds(all.start - Time{}))
        .set("end_s", to_seconds(all.start + all.duration - Time{}))
        .set("seed", static_cast<std::int64_t>(task.seed));
    end_document(document, session.context);
    std::cout << document.text();
    return;
  }
  if (all.source.fit) std::cout << fit_text(*all.source.fit);
  std::cout << counts.imu_samples << " samples of " << rig.imus.size() << " IMUs, " << counts.features.frames
            << " frames of " << rig.cameras.size() << " cameras with " << counts.features.features << " features of "
            << all.scene.scene.landmarks.size() << " landmarks over " << number_text(to_seconds(all.duration), 9)
            << " s written to " << task.out << "\n";
}

/// Proves before anything is written that all of it can be.
void probe_outputs(const RigTask& task, const RigInputs& all, OutputOptions options) {
  if (task.flags.images) require_surfaces(all.scene.scene);
  if (task.flags.wants("course")) require_course(all.document.rig);
  std::vector<std::string> paths = rig_output_paths(task.out, all.document.rig, all.scene);
  if (task.flags.wants("course")) paths.push_back(task.out + "/course/README.txt");
  for (const char* name : {"bag", "mcap"}) {
    if (task.flags.wants(name)) paths.push_back(bag_path(name, task.out));
  }
  for (const std::string& path : paths) probe_output(path, 0, options);
}

}  // namespace

void simulate_rig(const RigTask& task, Session& session) {
  const OutputOptions options = output_options(session);
  probe_output(task.out + "/rig.yaml", 0, options);
  const RigInputs all = load_inputs(task, session);
  probe_outputs(task, all, options);
  Counts counts;
  const OutputGuard guard;
  Bags bags = bag_outputs(task, all.document.rig, options);
  for (std::size_t i = 0; i < all.document.rig.imus.size(); ++i) write_imu(task, all, i, options, bags, counts);
  write_cameras(task, all, options, bags, counts);
  for (const auto& bag : bags) bag->publish();
  if (task.flags.wants("course")) write_rig_course(task, all, options);
  for (const std::string& note : write_rig_files(task.out, all.document, all.scene, options)) {
    session.add({.code = "W-KALIBR", .message = note, .where = task.out + "/kalibr", .effect = "", .next = ""});
  }
  warn(session, counts.imu_outside, "W-SPAN", " IMU samples lie outside the trajectory", "they are left out");
  warn(session, counts.features.frames_outside, "W-SPAN", " frames lie outside the trajectory", "they are left out");
  warn(session, counts.images_outside, "W-SPAN", " images are exposed outside the trajectory", "they are not rendered");
  warn(session, counts.features.unsolved, "W-SHUTTER", " times a landmark moved along with the reading of its lines",
       "it is left out of that image");
  session.finish();
  print_summary(task, all, counts, session);
}

}  // namespace vispline::cli

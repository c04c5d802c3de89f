#include "vispline/simulate/feature_simulation.h"

#include <cmath>
#include <numbers>
#include <string>

#include "vispline/core/error.h"
#include "vispline/core/parallel.h"
#include "vispline/core/random.h"
#include "vispline/simulate/shutter_view.h"

namespace vispline {
namespace {

constexpr std::size_t kBlock = 64;  // frames that are projected side by side

/// What could be seen in one image.
struct Projected {
  FrameInstant instant{};
  bool is_outside = false;
  std::size_t unsolved = 0;
  Time body_time{};
  BodyState body{};
  std::vector<VisibleLandmark> visible{};
  std::vector<double> line_s{};  ///< one for each
};

void check_probability(double value, const char* what) {
  require(value >= 0.0 && value <= 1.0, std::string("a probability from 0 to 1 of ") + what);
}

std::vector<std::string> names_of(const std::vector<Camera>& cameras) {
  std::vector<std::string> names;
  for (const Camera& camera : cameras) names.push_back(camera.name);
  return names;
}

/// The random numbers of one camera, by image and landmark.
struct Draws {
  RandomStream pixel, fate, outlier;
  Draws(std::uint64_t seed, const std::string& camera)
      : pixel(seed, camera + "/pixel"), fate(seed, camera + "/fate"), outlier(seed, camera + "/outlier") {}
};

class Simulator {
 public:
  Simulator(const Trajectory& trajectory, const Rig& rig, const Scene& scene, const FeatureSimulation& options)
      : trajectory_(trajectory),
        cameras_(rig.cameras),
        scene_(scene),
        options_(options),
        tracker_(options.tracks, options.seed, names_of(rig.cameras), scene.landmarks.size()) {
    for (const Camera& camera : cameras_) draws_.emplace_back(options.seed, camera.name);
  }

  /// All landmarks that the image could show. Any thread.
  Projected project(const FrameInstant& instant) const {
    const Camera& camera = cameras_[instant.camera];
    const ShutterView view(trajectory_, camera, instant);
    Projected projected{.instant = instant, .is_outside = !view.is_covered()};
    if (projected.is_outside) return projected;
    projected.body_time = instant.stamp + from_seconds(instant.clock_delay_s + camera.time_offset_s);
    projected.body = trajectory_.at(projected.body_time).value();
    for (std::size_t i = 0; i < scene_.landmarks.size(); ++i) {
      const SceneLandmark& landmark = scene_.landmarks[i];
      const ShutterSight sight = view.see(scene_, landmark);
      projected.unsolved += sight.is_unsolved;
      if (!sight.px) continue;
      projected.visible.push_back({i, landmark.id, *sight.px});
      projected.line_s.push_back(camera.delay_s(*sight.px) - camera.time_offset_s);
    }
    return projected;
  }

  /// What the front end makes of it; images in order.
  void finish(const Projected& projected, SimulatedFrame& frame) {
    frame.instant = projected.instant;
    frame.body_time = projected.body_time;
    frame.body = projected.body;
    frame.features.clear();
    frame.truth.clear();
    const auto& [camera, index, stamp, delay] = projected.instant;
    for (const TrackedLandmark& tracked : tracker_.track(camera, index, projected.visible)) {
      add_feature(projected, tracked, frame);
    }
  }

 private:
  void add_feature(const Projected& projected, const TrackedLandmark& tracked, SimulatedFrame& frame) const {
    const VisibleLandmark& landmark = projected.visible[tracked.visible];
    const std::size_t camera = projected.instant.camera;
    const Draws& draws = draws_[camera];
    const std::uint64_t draw = projected.instant.index * scene_.landmarks.size() + landmark.index;
    const auto [dropped, wrong] = draws.fate.uniform_pair(draw);
    if (dropped <= options_.dropout) return;
    const bool is_outlier = wrong <= options_.outliers;
    const auto [u, v] = draws.pixel.normal_pair(draw);
    Vector2d px = landmark.px + cameras_[camera].pixel_sigma_px * Vector2d(u, v);
    if (is_outlier) px += displacement(draws, draw);
    frame.features.push_back({tracked.id, px});
    frame.truth.push_back({landmark.id, landmark.px, projected.line_s[tracked.visible], is_outlier});
  }

  Vector2d displacement(const Draws& draws, std::uint64_t draw) const {
    const auto [turn, far] = draws.outlier.uniform_pair(draw);
    const double angle = 2.0 * std::numbers::pi * turn, length = options_.outlier_px * (0.25 + 0.75 * far);
    return length * Vector2d(std::cos(angle), std::sin(angle));
  }

  const Trajectory& trajectory_;
  const std::vector<Camera>& cameras_;
  const Scene& scene_;
  const FeatureSimulation& options_;
  FeatureTracker tracker_;
  std::vector<Draws> draws_;
};

void count(const SimulatedFrame& frame, FeatureCounts& counts) {
  ++counts.frames;
  counts.features += frame.features.size();
  for (const FeatureTruth& truth : frame.truth) counts.outliers += truth.is_outlier;
}

[[noreturn]] void fail_span(const FeatureCounts& counts, TimeSpan span) {
  throw Error(ExitCode::kUnfit,
              {.code = "E-SPAN",
               .message = "none of the " + std::to_string(counts.frames_outside) +
                          " images lies inside the trajectory, which spans " + std::to_string(to_ns(span.begin)) +
                          " to " + std::to_string(to_ns(span.end)) + " ns",
               .where = "",
               .effect = "nothing simulated",
               .next = "choose a start and a duration inside the trajectory"});
}

}  // namespace

FeatureCounts simulate_features(const Trajectory& trajectory, const Rig& rig, const Scene& scene, Time start,
                                Duration duration, const FeatureSimulation& options, const FrameSink& sink) {
  require_valid(rig);
  require_valid(scene);
  check_probability(options.dropout, "a dropout");
  check_probability(options.outliers, "an outlier");
  Simulator simulator(trajectory, rig, scene, options);
  CameraFrames frames(rig.cameras, options.clocks, start, duration);
  FeatureCounts counts;
  SimulatedFrame frame;
  for (std::vector<Projected> block; true; block.clear()) {
    while (block.size() < kBlock) {
      const auto instant = frames.next();
      if (!instant) break;
      block.push_back({.instant = *instant});
    }
    if (block.empty()) break;
    parallel_for(block.size(), options.threads, [&](std::size_t i) { block[i] = simulator.project(block[i].instant); });
    for (const Projected& projected : block) {
      counts.frames_outside += projected.is_outside;
      counts.unsolved += projected.unsolved;
      if (projected.is_outside) continue;
      simulator.finish(projected, frame);
      count(frame, counts);
      sink(frame);
    }
  }
  if (counts.frames == 0 && counts.frames_outside > 0) fail_span(counts, trajectory.span());
  return counts;
}

}  // namespace vispline

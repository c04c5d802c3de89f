/// Trajectory + cameras + scene -> features: exact projections first, then what a front end makes of them.
/// docs/math/features.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "vispline/core/body_state.h"
#include "vispline/sensors/recording.h"
#include "vispline/sensors/rig.h"
#include "vispline/simulate/camera_frames.h"
#include "vispline/simulate/feature_tracker.h"
#include "vispline/simulate/scene.h"
#include "vispline/trajectory/trajectory.h"

namespace vispline {

struct FeatureSimulation {
  TrackOptions tracks{};
  ClockModels clocks{};
  double dropout = 0.0;      ///< probability that a feature is missing in an image while its track goes on
  double outliers = 0.0;     ///< probability that a feature is displaced by
  double outlier_px = 20.0;  ///< up to so much, at least a quarter of it, on top of the noise
  std::uint64_t seed = 0;    ///< streams depend on the seed, the name of the camera, image and landmark only
  std::size_t threads = 1;   ///< does not change a byte of the result
};

/// The truth behind one feature.
struct FeatureTruth {
  std::uint64_t landmark = 0;            ///< id in the scene
  Vector2d exact_px = Vector2d::Zero();  ///< without noise
  double line_s = 0.0;                   ///< from the exposure of the first line to that of this feature
  bool is_outlier = false;
};

struct SimulatedFrame {
  FrameInstant instant{};
  Time body_time{};                   ///< nearest nanosecond of the body's clock to the first line
  BodyState body{};                   ///< at body_time
  std::vector<Feature> features{};    ///< by id; pixels with the noise of the camera
  std::vector<FeatureTruth> truth{};  ///< one for each feature
};

struct FeatureCounts {
  std::size_t frames = 0;
  std::size_t features = 0;
  std::size_t outliers = 0;
  std::size_t frames_outside = 0;  ///< left out: the trajectory does not cover all their lines
  std::size_t unsolved = 0;  ///< landmarks in sight whose line could not be told: the image moves with the reading
};

/// Called on the calling thread in the order of CameraFrames; the frame is reused after the call returns.
using FrameSink = std::function<void(const SimulatedFrame& frame)>;

/// All images of the rig's cameras in [start, start + duration). Each feature is where the landmark is when its line is
/// exposed; the root is exact to 1e-9 px, not to the nanosecond. Memory does not grow with the duration. Throws as
/// require_valid() of rig, scene and tracks, E-ARGUMENT for probabilities outside 0 to 1, and Error(kUnfit, E-SPAN) if
/// the trajectory covers no image.
FeatureCounts simulate_features(const Trajectory& trajectory, const Rig& rig, const Scene& scene, Time start,
                                Duration duration, const FeatureSimulation& options, const FrameSink& sink);

}  // namespace vispline

// Spline Fusion on simulated tracks: trajectory, points and rig from a start that knows the lens only.
#include "vispline/estimate/track_estimation.h"

#include <gtest/gtest.h>

#include "vispline/estimate/simulated_testing.h"

namespace vispline {
namespace {

using testing::Simulated;

TrackEstimationOptions options_of(const CurveShape& shape) {
  TrackEstimationOptions options;
  options.curve = shape;
  options.gravity = testing::kGravity;
  return options;
}

TEST(TrackEstimation, NoisyTracksWithinFourSigmas) {
  const Simulated data({.duration_s = 8.0, .target = false, .seed = 2});
  const Estimation estimation =
      estimate_with_tracks(data.start(), data.recording, options_of({SplineKind::kJoint, 4, from_seconds(0.06)}));
  testing::expect_truth(estimation, data.truth, 4.0);
  for (const Stage& stage : estimation.stages) EXPECT_TRUE(stage.passed) << stage.name << " " << stage.value;
}

TEST(TrackEstimation, TheWorldIsLevel) {
  const Simulated data({.duration_s = 5.0, .target = false, .seed = 3});
  const Estimation estimation =
      estimate_with_tracks(data.start(), data.recording, options_of({SplineKind::kSplit, 4, from_seconds(0.08)}));
  const State& state = estimation.solution.state;
  EXPECT_EQ(state.g_w, Vector3d(0.0, 0.0, -testing::kGravity));
  for (const double t : {1.0, 2.5, 4.0}) {
    const Vector3d up_b = state.curve->pose({Time{} + from_seconds(t)}).R.row(2).transpose();
    const Vector3d truth_b = data.T_w_b.at(Time{} + from_seconds(t))->R_w_b.row(2).transpose();
    EXPECT_LT((up_b - truth_b).norm(), 0.01) << t;
  }
}

TEST(TrackEstimation, TracksAreSortedAndLongEnough) {
  const Simulated data({.duration_s = 2.0, .target = false});
  const auto tracks = tracks_of(data.truth, data.recording, data.imu().span(), 4);
  ASSERT_GT(tracks.size(), 20u);
  for (const Track& track : tracks) {
    EXPECT_GE(track.sightings.size(), 4u);
    for (std::size_t i = 1; i < track.sightings.size(); ++i) {
      EXPECT_LT(track.sightings[i - 1].stamp, track.sightings[i].stamp);
    }
  }
}

TEST(TrackEstimation, TooFewTracksAreNamed) {
  Simulated data({.duration_s = 2.0, .target = false});
  for (auto& frame : data.recording.features.at("cam0").value) frame.resize(std::min<std::size_t>(frame.size(), 1));
  try {
    estimate_with_tracks(data.start(), data.recording, options_of({}));
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.diagnostic().code, "E-TRACKS") << error.what();
  }
}

}  // namespace
}  // namespace vispline

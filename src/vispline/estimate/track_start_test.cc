// Positions, points, gravity and bias by linear least squares, once rotations are known: against a simulated cloud.
#include "vispline/estimate/track_start.h"

#include <gtest/gtest.h>

#include "vispline/estimate/simulated_testing.h"
#include "vispline/estimate/track_estimation.h"

namespace vispline {
namespace {

using testing::Simulated;

TrackStartInput input_of(const Simulated& data) {
  TrackStartInput input;
  input.rig = data.truth;
  input.R_w_b = [&data](Time t) { return data.T_w_b.at(t)->R_w_b; };
  input.imu_time = data.imu().time;
  input.imu = data.imu().value;
  input.span = {data.imu().time.front(), data.imu().time.back()};
  input.tracks = tracks_of(data.truth, data.recording, input.span, 3);
  input.accel_sigma = 0.02;
  input.bearing_sigma = 1e-3;
  input.gravity = testing::kGravity;
  input.spacing = from_seconds(0.05);
  return input;
}

TEST(TrackStart, RecoversMotionGravityAndBias) {
  const Simulated data({.target = false, .seed = 5});
  const auto start = start_from_tracks(input_of(data));
  ASSERT_TRUE(start);
  EXPECT_LT((start->g_w - Vector3d(0.0, 0.0, -testing::kGravity)).norm(), 0.05);
  EXPECT_LT((start->accel_bias - data.truth.imus[0].accelerometer.bias).norm(), 0.05);
  EXPECT_LT(start->bearing_rms, 3e-3);
  const Vector3d origin = start->p_w(Time{} + from_seconds(3.0)) - data.T_w_b.at(Time{} + from_seconds(3.0))->p_w;
  for (const double t : {1.0, 2.0, 4.0, 5.0}) {
    const Time time = Time{} + from_seconds(t);
    EXPECT_LT((start->p_w(time) - data.T_w_b.at(time)->p_w - origin).norm(), 0.02) << t;
  }
}

/// Rays of the points meet the points: those that are placed lie on their rays.
TEST(TrackStart, PointsLieOnTheirRays) {
  const Simulated data({.target = false, .seed = 6});
  const TrackStartInput input = input_of(data);
  const auto start = start_from_tracks(input);
  ASSERT_TRUE(start);
  std::size_t placed = 0;
  for (std::size_t i = 0; i < input.tracks.size(); ++i) {
    if (!start->point_w[i]) continue;
    ++placed;
    const Sighting& s = input.tracks[i].sightings.front();
    const Camera& camera = data.truth.cameras[0];
    const Time at = s.stamp + from_seconds(camera.delay_s(s.px));
    const Pose T_w_b{data.T_w_b.at(at)->R_w_b, start->p_w(at)};
    const Vector3d point_c = camera.T_c_b * (T_w_b.inverse() * *start->point_w[i]);
    EXPECT_LT((point_c.normalized() - *camera.lens.unproject(s.px)).norm(), 0.02) << i;
  }
  EXPECT_GT(2 * placed, input.tracks.size());
}

TEST(TrackStart, TracksWithoutParallaxLeaveNoPoint) {
  const Simulated data({.target = false, .seed = 5});
  TrackStartInput input = input_of(data);
  Track& still = input.tracks.front();
  still.sightings.resize(1);
  const auto start = start_from_tracks(input);
  ASSERT_TRUE(start);
  EXPECT_EQ(start->point_w.size(), input.tracks.size());
}

}  // namespace
}  // namespace vispline

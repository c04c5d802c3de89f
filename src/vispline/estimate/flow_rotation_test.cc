// The turning of a camera from tracks, against the camera that turned.
#include "vispline/estimate/flow_rotation.h"

#include <gtest/gtest.h>

#include "vispline/estimate/simulated_testing.h"

namespace vispline {
namespace {

TEST(FlowRotation, ExactForPointsAtInfinity) {
  Camera camera = testing::simulated_camera();
  camera.shutter.line_delay_s = 0.0;
  const Vector3d omega_c(0.4, -0.7, 0.5);
  FeatureSignal features;
  for (int f = 0; f < 4; ++f) {
    const Matrix3d R_c_w = SO3::exp<double>(Vector3d(-0.05 * f * omega_c));
    std::vector<Feature> seen;
    for (std::uint64_t i = 0; i < 30; ++i) {
      const Vector3d direction(0.1 * (static_cast<double>(i % 6) - 2.5), 0.15 * (static_cast<double>(i / 6) - 2.0),
                               1.0);
      seen.push_back({i, *camera.lens.project(R_c_w * direction)});
    }
    seen[7].px += Vector2d(20.0, 5.0 * f);  // what is near moves otherwise
    features.push_back(time_from_ns(50'000'000L * f), seen);
  }
  const ImuSignal rate = turning_rate(camera, features);
  ASSERT_EQ(rate.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT((rate.value[i].gyro - omega_c).norm(), 1e-4);
    EXPECT_EQ(to_ns(rate.time[i]), 25'000'000 + 50'000'000 * static_cast<std::int64_t>(i));
  }
}

TEST(FlowRotation, CloseToTheGyroscopeOnTracksOfACloud) {
  const testing::Simulated data({.duration_s = 4.0, .target = false});
  const Camera& camera = data.truth.cameras[0];
  const ImuSignal rate = turning_rate(camera, data.recording.features.at("cam0"));
  ASSERT_GT(rate.size(), 70u);
  double square = 0.0, turning = 0.0;
  for (std::size_t i = 0; i < rate.size(); ++i) {
    const auto state = data.T_w_b.at(rate.time[i] + from_seconds(camera.time_offset_s));
    square += (rate.value[i].gyro - camera.T_c_b.R * state->omega_b).squaredNorm();
    turning += state->omega_b.squaredNorm();
  }
  EXPECT_LT(std::sqrt(square / turning), 0.2);
}

TEST(FlowRotation, FewCommonFeaturesGiveNothing) {
  FeatureSignal features;
  for (int f = 0; f < 3; ++f) {
    std::vector<Feature> seen;
    for (std::uint64_t i = 0; i < 7; ++i) seen.push_back({i, Vector2d(40.0 * static_cast<double>(i), 200.0)});
    features.push_back(time_from_ns(50'000'000L * f), seen);
  }
  EXPECT_TRUE(turning_rate(testing::simulated_camera(), features).empty());
}

}  // namespace
}  // namespace vispline

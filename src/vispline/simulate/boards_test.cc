#include "vispline/simulate/boards.h"

#include <gtest/gtest.h>

#include <array>

#include "vispline/core/error.h"
#include "vispline/core/se3.h"

namespace vispline {
namespace {

Pose generic_pose() {
  Vector6d xi;
  xi << -0.2, 0.5, 0.9, 1.4, 0.3, -0.8;
  return SE3::exp<double>(xi);
}

Vector3d in_board(const Scene& scene, const Pose& T_w_t, std::size_t landmark) {
  EXPECT_EQ(scene.landmarks[landmark].id, landmark);
  return T_w_t.inverse() * scene.landmarks[landmark].point_w;
}

TEST(AprilGridScene, HasTheCornersOfKalibrsBoard) {
  const Pose T_w_t = generic_pose();
  const Scene scene = aprilgrid_scene({.cols = 6, .rows = 5, .tag_size_m = 0.1, .tag_spacing = 0.25}, T_w_t);
  ASSERT_EQ(scene.landmarks.size(), 120u);
  const auto tag = 2 * 6 + 3;  // third row from below, fourth column
  const std::array<Vector3d, 4> corners{Vector3d(0.375, 0.25, 0), Vector3d(0.475, 0.25, 0), Vector3d(0.475, 0.35, 0),
                                        Vector3d(0.375, 0.35, 0)};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_LT((in_board(scene, T_w_t, 4 * tag + k) - corners[k]).norm(), 1e-12) << k;
  }
}

TEST(AprilGridScene, IsSeenFromItsFront) {
  const Pose T_w_t = generic_pose();
  const Scene scene = aprilgrid_scene({}, T_w_t);
  for (const SceneLandmark& landmark : scene.landmarks) {
    ASSERT_TRUE(scene.in_sight(T_w_t * Vector3d(0.1, -0.3, 0.6), landmark));
    ASSERT_FALSE(scene.in_sight(T_w_t * Vector3d(0.1, -0.3, -0.6), landmark));
  }
}

TEST(CheckerboardScene, CountsInnerCornersRowByRow) {
  const Pose T_w_t = generic_pose();
  const Scene scene = checkerboard_scene({.cols = 7, .rows = 4, .col_spacing_m = 0.03, .row_spacing_m = 0.05}, T_w_t);
  ASSERT_EQ(scene.landmarks.size(), 28u);
  EXPECT_LT((in_board(scene, T_w_t, 2 * 7 + 5) - Vector3d(0.15, 0.1, 0)).norm(), 1e-12);
}

TEST(CircleGridScene, OddRowsOfAnAsymmetricOneAreShifted) {
  const Pose T_w_t = generic_pose();
  const Scene even = circle_grid_scene({.cols = 4, .rows = 11, .spacing_m = 0.02, .radius_m = 0.006}, T_w_t);
  const Scene odd =
      circle_grid_scene({.cols = 4, .rows = 11, .spacing_m = 0.02, .radius_m = 0.006, .is_asymmetric = true}, T_w_t);
  EXPECT_LT((in_board(even, T_w_t, 3 * 4 + 2) - Vector3d(0.04, 0.06, 0)).norm(), 1e-12);
  EXPECT_LT((in_board(odd, T_w_t, 3 * 4 + 2) - Vector3d(0.1, 0.06, 0)).norm(), 1e-12);
  EXPECT_LT((in_board(odd, T_w_t, 2 * 4 + 2) - Vector3d(0.08, 0.04, 0)).norm(), 1e-12);
}

TEST(Boards, EveryPointIsInsideTheSheet) {
  const Pose T_w_t = generic_pose();
  for (const Scene& scene : {aprilgrid_scene({}, T_w_t), checkerboard_scene({}, T_w_t), circle_grid_scene({}, T_w_t),
                             circle_grid_scene({.is_asymmetric = true}, T_w_t)}) {
    const Surface& sheet = scene.surfaces.at(0);
    for (const SceneLandmark& landmark : scene.landmarks) {
      const Vector3d p_s = sheet.T_w_s.inverse() * landmark.point_w;
      ASSERT_GT(p_s.head<2>().minCoeff(), 0.01);
      ASSERT_GT((sheet.size_m - p_s.head<2>()).minCoeff(), 0.01);
      ASSERT_NEAR(p_s.z(), 0.0, 1e-12);
    }
  }
}

TEST(Boards, ImpossibleOnesAreRefused) {
  EXPECT_THROW(aprilgrid_scene({.cols = 30, .rows = 20}, {}), Error);  // 600 tags, the family has 587
  EXPECT_THROW(aprilgrid_scene({.tag_spacing = 0.0}, {}), Error);
  EXPECT_THROW(checkerboard_scene({.cols = 0}, {}), Error);
  EXPECT_THROW(circle_grid_scene({.radius_m = 0.02}, {}), Error);
  EXPECT_THROW(circle_grid_scene({.cols = 200, .rows = 200}, {}), Error);
}

}  // namespace
}  // namespace vispline

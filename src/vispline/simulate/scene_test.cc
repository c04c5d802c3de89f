#include "vispline/simulate/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "vispline/core/error.h"
#include "vispline/core/se3.h"
#include "vispline/simulate/boards.h"
#include "vispline/simulate/box_room.h"
#include "vispline/simulate/random_cloud.h"

namespace vispline {
namespace {

Pose generic_pose() {
  Vector6d xi;
  xi << 0.3, -0.7, 1.1, 0.4, -0.9, 1.6;
  return SE3::exp<double>(xi);
}

/// A wall of 2 m x 1 m, anywhere, with a point half a metre behind its centre.
class Wall : public ::testing::Test {
 protected:
  Wall() { scene_.surfaces.push_back({.T_w_s = T_w_s_, .size_m = {2.0, 1.0}}); }
  Vector3d at(double x, double y, double z) const { return T_w_s_ * Vector3d(x, y, z); }

  Pose T_w_s_ = generic_pose();
  Scene scene_;
  SceneLandmark behind_{.id = 3, .point_w = at(1.0, 0.5, -0.5)};
};

TEST_F(Wall, HidesWhatIsBehindIt) {
  EXPECT_FALSE(scene_.in_sight(at(1.0, 0.5, 2.0), behind_));
  EXPECT_TRUE(scene_.in_sight(at(1.0, 0.5, -2.0), behind_));
  EXPECT_FALSE(scene_.in_sight(at(1.0, 0.5, 1e-3), behind_));
}

TEST_F(Wall, EndsAtItsEdges) {
  // From (x, 0.5, 0.5) the ray crosses the wall's plane half-way, at (x + 1) / 2.
  EXPECT_FALSE(scene_.in_sight(at(2.99, 0.5, 0.5), behind_));
  EXPECT_TRUE(scene_.in_sight(at(3.01, 0.5, 0.5), behind_));
  EXPECT_FALSE(scene_.in_sight(at(-0.99, 0.5, 0.5), behind_));
  EXPECT_TRUE(scene_.in_sight(at(-1.01, 0.5, 0.5), behind_));
  EXPECT_TRUE(scene_.in_sight(at(1.0, 1.51, 0.5), behind_));
  EXPECT_TRUE(scene_.in_sight(at(1.0, -0.51, 0.5), behind_));
}

TEST_F(Wall, ShowsThePointsOnItToItsFrontOnly) {
  const SceneLandmark on{.id = 0, .point_w = at(0.4, 0.8, 0.0), .normal_w = T_w_s_.R.col(2)};
  EXPECT_TRUE(scene_.in_sight(at(1.7, -0.2, 1.3), on));
  EXPECT_FALSE(scene_.in_sight(at(1.7, -0.2, -1.3), on));
  EXPECT_TRUE(scene_.in_sight(at(1.7, -0.2, -1.3), {.id = 0, .point_w = on.point_w}));
}

TEST_F(Wall, OnlyDistancesOfTheRangeAreSeen) {
  scene_.min_distance_m = 1.0;
  scene_.max_distance_m = 3.0;
  EXPECT_FALSE(scene_.in_sight(at(1.0, 0.5, -1.49), behind_));
  EXPECT_TRUE(scene_.in_sight(at(1.0, 0.5, -1.51), behind_));
  EXPECT_TRUE(scene_.in_sight(at(1.0, 0.5, -3.49), behind_));
  EXPECT_FALSE(scene_.in_sight(at(1.0, 0.5, -3.51), behind_));
}

TEST(Scene, AddedScenesKeepTheirOrderUnderNewIds) {
  Scene scene = point_scene({{1, 2, 3}, {4, 5, 6}});
  EXPECT_EQ(add_scene(scene, checkerboard_scene({.cols = 2, .rows = 2}, generic_pose())), 2u);
  ASSERT_EQ(scene.landmarks.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(scene.landmarks[i].id, i);
  EXPECT_EQ(scene.surfaces.size(), 1u);
  EXPECT_NO_THROW(require_valid(scene));
}

TEST(Scene, WrongOnesAreRefused) {
  Scene twice = point_scene({{1, 2, 3}, {4, 5, 6}}), infinite = twice, flat, mirrored, normal = infinite;
  twice.landmarks[1].id = 0;
  infinite.landmarks[0].point_w.y() = NAN;
  flat.surfaces.push_back({.size_m = {1.0, 0.0}});
  mirrored.surfaces.push_back({.T_w_s = {-Matrix3d::Identity(), Vector3d::Zero()}});
  normal.landmarks[0].normal_w = Vector3d(1, 1, 0);
  for (const Scene& scene : {twice, infinite, flat, mirrored, normal}) EXPECT_THROW(require_valid(scene), Error);
}

TEST(RandomCloud, FillsItsBoxAndFewerAreTheFirstOfMore) {
  const RandomCloud box{.count = 4000, .lower_w = {1, -2, 3}, .upper_w = {2, 4, 3.5}, .seed = 5};
  const Scene scene = random_cloud(box);
  Vector3d mean = Vector3d::Zero();
  for (const SceneLandmark& landmark : scene.landmarks) {
    ASSERT_GE((landmark.point_w - box.lower_w).minCoeff(), 0.0);
    ASSERT_GE((box.upper_w - landmark.point_w).minCoeff(), 0.0);
    mean += landmark.point_w / 4000.0;
  }
  const Vector3d off = (mean - 0.5 * (box.lower_w + box.upper_w)).cwiseQuotient(box.upper_w - box.lower_w);
  EXPECT_LT(off.cwiseAbs().maxCoeff(), 5.0 / std::sqrt(12.0 * 4000.0));
  RandomCloud fewer = box;
  fewer.count = 10;
  EXPECT_EQ(random_cloud(fewer).landmarks[9].point_w, scene.landmarks[9].point_w);
}

TEST(BoxRoom, EveryPointIsOnAWallAndInSightOfAllTheInside) {
  const BoxRoom box{.lower_w = {-3, -2, -1}, .upper_w = {4, 5, 2}, .landmarks = 400, .seed = 9};
  const Scene room = box_room(box);
  ASSERT_EQ(room.surfaces.size(), 6u);
  require_valid(room);
  for (const SceneLandmark& landmark : room.landmarks) {
    const Vector3d low = landmark.point_w - box.lower_w, high = box.upper_w - landmark.point_w;
    ASSERT_GE(low.minCoeff(), 0.0);
    ASSERT_GE(high.minCoeff(), 0.0);
    ASSERT_EQ(std::min(low.minCoeff(), high.minCoeff()), 0.0);
    ASSERT_TRUE(room.in_sight({3.5, -1.5, 1.5}, landmark));
    ASSERT_TRUE(room.in_sight({-2.5, 4.5, -0.5}, landmark));
    ASSERT_FALSE(room.in_sight({9.0, 8.0, 7.0}, landmark));
  }
}

TEST(BoxRoom, AWallHasPointsByItsArea) {
  const Scene room = box_room({.lower_w = {0, 0, 0}, .upper_w = {1, 2, 4}, .landmarks = 7000});
  std::array<int, 6> count{};
  for (const SceneLandmark& landmark : room.landmarks) {
    for (std::size_t i = 0; i < 6; ++i) count[i] += landmark.normal_w == room.surfaces[i].T_w_s.R.col(2);
  }
  const std::array<int, 6> expected{2000, 2000, 1000, 1000, 500, 500};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(count[i], expected[i], 200) << i;
}

TEST(BoxRoom, TheMiddleOfEveryWallFacesTheMiddleOfTheRoom) {
  const Scene room = box_room({.lower_w = {1, 2, 3}, .upper_w = {3, 6, 9}, .landmarks = 0});
  const std::array<Vector3d, 6> middles{Vector3d(1, 4, 6), Vector3d(3, 4, 6), Vector3d(2, 2, 6),
                                        Vector3d(2, 6, 6), Vector3d(2, 4, 3), Vector3d(2, 4, 9)};
  for (std::size_t i = 0; i < 6; ++i) {
    const Surface& wall = room.surfaces[i];
    const Vector3d middle = wall.T_w_s * Vector3d(wall.size_m.x() / 2, wall.size_m.y() / 2, 0.0);
    EXPECT_LT((middle - middles[i]).norm(), 1e-12) << i;
    EXPECT_GT(wall.T_w_s.R.col(2).dot(Vector3d(2, 4, 6) - middle), 0.0) << i;
  }
}

}  // namespace
}  // namespace vispline

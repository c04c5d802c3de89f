// Poses from points, exact ones first, then what a detector does to them.
#include "vispline/estimate/pnp.h"

#include <gtest/gtest.h>

#include "vispline/core/random.h"
#include "vispline/core/so3.h"

namespace vispline {
namespace {

Camera camera() {
  Camera camera;
  camera.lens = {LensModel::kPinholeRadtan,
                 (LensParams(8) << 420.0, 431.0, 318.0, 241.0, -0.11, 0.02, 0.001, -0.0007).finished()};
  return camera;
}

const Pose kT_t_c{SO3::exp<double>(Vector3d(2.8, 0.3, -0.2)), Vector3d(0.1, -0.2, 1.4)};

std::vector<Vector3d> points(bool flat) {
  std::vector<Vector3d> points;
  for (int i = 0; i < 20; ++i) {
    points.emplace_back(0.1 * (i % 5), 0.1 * (i / 5) - 0.2, flat ? 0.0 : 0.07 * ((7 * i) % 4));
  }
  return points;
}

std::vector<Vector2d> seen(const std::vector<Vector3d>& points, double sigma_px) {
  const RandomStream stream(5, "pixel");
  std::vector<Vector2d> px;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto z = stream.normal_pair(i);
    px.push_back(*camera().lens.project(kT_t_c.inverse() * points[i]) + sigma_px * Vector2d(z[0], z[1]));
  }
  return px;
}

double turned(const Pose& T_t_c) { return SO3::log<double>(Matrix3d(T_t_c.R.transpose() * kT_t_c.R)).norm(); }

TEST(Pnp, ExactPointsGiveTheExactPose) {
  for (const bool flat : {true, false}) {
    const auto pose = camera_pose(camera(), seen(points(flat), 0.0), points(flat));
    ASSERT_TRUE(pose);
    EXPECT_LT((pose->T_t_c.p - kT_t_c.p).norm(), 1e-9) << flat;
    EXPECT_LT(turned(pose->T_t_c), 1e-9) << flat;
    EXPECT_EQ(pose->inliers, 20);
    EXPECT_LT(pose->rms_px, 1e-7);
  }
}

/// rms^2 = sigma^2 (1 - 6 / 40) for six unknowns and forty numbers.
TEST(Pnp, NoiseIsLeftInTheResiduals) {
  const auto pose = camera_pose(camera(), seen(points(true), 0.4), points(true));
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->rms_px, 0.4 * std::sqrt(1.0 - 6.0 / 40.0), 0.1);
  EXPECT_LT((pose->T_t_c.p - kT_t_c.p).norm(), 0.08);
}

TEST(Pnp, OutliersAreWeighedDown) {
  for (const bool flat : {true, false}) {
    auto px = seen(points(flat), 0.1);
    px[3] += Vector2d(30.0, -10.0);
    px[11] += Vector2d(-15.0, 25.0);
    const auto pose = camera_pose(camera(), px, points(flat));
    ASSERT_TRUE(pose) << flat;
    EXPECT_EQ(pose->inliers, 18) << flat;
    EXPECT_LT((pose->T_t_c.p - kT_t_c.p).norm(), 0.03) << flat;
    EXPECT_LT(turned(pose->T_t_c), 0.02) << flat;
  }
}

TEST(Pnp, TooLittleIsNoPose) {
  const auto flat = points(true);
  const auto first = [](auto list, std::size_t n) {
    return decltype(list)(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(n));
  };
  EXPECT_FALSE(camera_pose(camera(), first(seen(flat, 0.0), 3), first(flat, 3)));
  auto px = seen(flat, 0.0);
  std::reverse(px.begin(), px.begin() + 13);
  EXPECT_FALSE(camera_pose(camera(), px, flat));
}

}  // namespace
}  // namespace vispline

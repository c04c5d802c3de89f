#include "vispline/core/se3.h"

#include <gtest/gtest.h>

#include <unsupported/Eigen/MatrixFunctions>

#include "vispline/core/lie_testing.h"

namespace vispline::testing {
namespace {

Eigen::Matrix4d homogeneous(const Pose& X) {
  Eigen::Matrix4d M = Eigen::Matrix4d::Identity();
  M.topLeftCorner<3, 3>() = X.R;
  M.topRightCorner<3, 1>() = X.p;
  return M;
}

TEST(SE3, ExpIsTheMatrixExponential) {
  for (const Vector6d& xi : nasty_tangents<SE3>()) {
    Eigen::Matrix4d M = Eigen::Matrix4d::Zero();
    M.topLeftCorner<3, 3>() = hat<double>(xi.tail<3>());
    M.topRightCorner<3, 1>() = xi.head<3>();
    EXPECT_LT(distance(homogeneous(SE3::exp<double>(xi)), M.exp()), 2e-14) << xi.transpose();
  }
}

TEST(SE3, QuarterScrewEndsWhereTheCircleDoes) {
  // Forward at 1 m per unit while turning left by pi/2: the end of a quarter circle of radius 2/pi.
  constexpr double pi = std::numbers::pi;
  const Pose X = SE3::exp<double>((Vector6d() << 1, 0, 0.5, 0, 0, pi / 2).finished());
  EXPECT_LT(distance(X.p, Vector3d(2 / pi, 2 / pi, 0.5)), 1e-15);
  EXPECT_LT(distance(X.R * Vector3d::UnitX(), Vector3d::UnitY()), 1e-15);
}

TEST(SE3, WithoutRotationTheTwistIsTheTranslation) {
  const Vector6d xi = (Vector6d() << 1, -2, 3, 0, 0, 0).finished();
  EXPECT_EQ(distance(SE3::exp<double>(xi), Pose{Matrix3d::Identity(), xi.head<3>()}), 0.0);
  EXPECT_EQ(distance(SE3::log<double>(SE3::exp<double>(xi)), xi), 0.0);
}

TEST(SE3, AdjointOfATranslationCarriesTheLeverArm) {
  // A body turning at omega about w's origin: a point at p has velocity p x omega seen in the shifted frame.
  const Vector3d p(0, 2, 0), omega(0, 0, 0.5);
  const Vector6d moved = SE3::Ad<double>(Pose{Matrix3d::Identity(), p}) * (Vector6d() << 0, 0, 0, omega).finished();
  EXPECT_EQ(distance(moved.head<3>(), Vector3d(1, 0, 0)), 0.0);
  EXPECT_EQ(distance(moved.tail<3>(), omega), 0.0);
}

}  // namespace
}  // namespace vispline::testing

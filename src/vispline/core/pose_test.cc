#include "vispline/core/pose.h"

#include <gtest/gtest.h>

#include "vispline/core/body_state.h"
#include "vispline/core/lie_testing.h"

namespace vispline::testing {
namespace {

Pose generic_pose() { return SE3::exp<double>((Vector6d() << 1.0, -0.5, 2.0, 0.3, -0.7, 1.1).finished()); }

TEST(Pose, MapsCoordinatesFromItsLastFrameToItsFirst) {
  const Pose T_w_b{Eigen::AngleAxisd(std::numbers::pi / 2, Vector3d::UnitZ()).toRotationMatrix(), {10, 0, 0}};
  EXPECT_LT(distance(T_w_b * Vector3d(1, 0, 0), Vector3d(10, 1, 0)), 1e-15);
}

TEST(Pose, ProductAppliesTheRightFactorFirst) {
  const Pose T_w_b = generic_pose(), T_b_c = SE3::exp<double>((Vector6d() << 0, 1, 0, 0.5, 0.1, 0).finished());
  const Vector3d point_c(0.2, 0.3, 4.0);
  EXPECT_LT(distance((T_w_b * T_b_c) * point_c, T_w_b * (T_b_c * point_c)), 1e-14);
}

TEST(Pose, InverseMapsBack) {
  const Vector3d point(0.2, 0.3, 4.0);
  EXPECT_LT(distance(generic_pose().inverse() * (generic_pose() * point), point), 1e-14);
}

TEST(Pose, QuaternionIsTheSameRotation) {
  const Pose T = generic_pose();
  EXPECT_LT(distance(T.quaternion().toRotationMatrix(), T.R), 1e-15);
  EXPECT_NEAR(T.quaternion().norm(), 1.0, 1e-15);
}

TEST(Pose, CastKeepsTheValues) {
  EXPECT_LT(distance(generic_pose().cast<float>().cast<double>(), generic_pose()), 3e-7);
  EXPECT_EQ(distance(generic_pose().cast<long double>().cast<double>(), generic_pose()), 0.0);
}

TEST(BodyState, CastKeepsEveryMemberAtItsPlace) {
  const BodyState state{generic_pose().R, {1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}, {13, 14, 15}};
  const BodyStateT<long double> wide = state.cast<long double>();
  EXPECT_EQ(distance(wide.R_w_b.cast<double>(), state.R_w_b), 0.0);
  EXPECT_EQ(distance(wide.p_w.cast<double>(), Vector3d(1, 2, 3)), 0.0);
  EXPECT_EQ(distance(wide.v_w.cast<double>(), Vector3d(4, 5, 6)), 0.0);
  EXPECT_EQ(distance(wide.omega_b.cast<double>(), Vector3d(7, 8, 9)), 0.0);
  EXPECT_EQ(distance(wide.a_w.cast<double>(), Vector3d(10, 11, 12)), 0.0);
  EXPECT_EQ(distance(wide.alpha_b.cast<double>(), Vector3d(13, 14, 15)), 0.0);
  EXPECT_EQ(distance(state.T_w_b().p, state.p_w), 0.0);
}

}  // namespace
}  // namespace vispline::testing

#include "vispline/trajectory/pose_spline.h"

#include <gtest/gtest.h>

#include "vispline/trajectory/spline_testing.h"
#include "vispline/trajectory/trajectory.h"

namespace vispline {
namespace {

using testing::derivatives;
using testing::dual_knots;
using testing::random_knots;

const Duration kSpacing = from_seconds(0.1);

template <class G>
class PoseSplines : public ::testing::Test {};
using Groups = ::testing::Types<SE3, SplitPose>;
TYPED_TEST_SUITE(PoseSplines, Groups);

TYPED_TEST(PoseSplines, BodyStateIsTheDerivativeOfThePose) {
  const PoseSpline<TypeParam, 4> spline({Time{}, kSpacing, random_knots<TypeParam>(2, 10, 0.4)});
  const Duration h = from_seconds(1e-5);
  const double two_h = 2.0 * to_seconds(h);
  for (const double t : {0.05, 0.123, 0.456, 0.65}) {
    const Time time = Time{} + from_seconds(t);
    const BodyState at = spline.at(time), after = spline.at(time + h), before = spline.at(time - h);
    EXPECT_LT((at.v_w - (after.p_w - before.p_w) / two_h).norm(), 1e-5);
    EXPECT_LT((at.omega_b - vee<double>(at.R_w_b.transpose() * (after.R_w_b - before.R_w_b) / two_h)).norm(), 1e-5);
    EXPECT_LT((at.a_w - (after.v_w - before.v_w) / two_h).norm(), 1e-4);
    EXPECT_LT((at.alpha_b - (after.omega_b - before.omega_b) / two_h).norm(), 1e-4);
    BodyTangent rate;
    rate << at.R_w_b.transpose() * at.v_w, at.omega_b, at.a_w, at.alpha_b, (after.a_w - before.a_w) / two_h,
        (after.alpha_b - before.alpha_b) / two_h;
    EXPECT_LT((spline.rate(time) - rate).norm(), 1e-6 * (1.0 + rate.norm()));
  }
}

template <class G, int K>
void expect_pull_back() {
  constexpr int kColumns = 6 * K;
  using Jet = ceres::Jet<double, kColumns>;
  const PoseSpline<G, K> spline({Time{}, kSpacing, random_knots<G>(9, 12, 0.4)});
  const Time time = Time{} + from_seconds(0.3271);
  const auto place = spline.spline().locate(time);
  std::array<Pose, K> knots;
  std::copy_n(spline.spline().knots().begin() + static_cast<std::ptrdiff_t>(place.first), K, knots.begin());
  const auto dual = cumulative_kinematics<G, K, Jet>(dual_knots<G, K>(knots),
                                                     CumulativeBasis<K, Jet>(Jet(place.u), to_seconds(kSpacing)));
  const BodyStateT<Jet> state = BodyFrame<G>::state(dual.X, dual.V, dual.dV);
  const Pose T_b_w = spline.at(time).T_w_b().inverse();
  const auto eps = SE3::log<Jet>(T_b_w.cast<Jet>() * state.T_w_b());
  Eigen::MatrixXd J(body_tangent::kSize, kColumns);
  J << derivatives<kColumns>(eps), derivatives<kColumns>(state.v_w), derivatives<kColumns>(state.omega_b),
      derivatives<kColumns>(state.a_w), derivatives<kColumns>(state.alpha_b);
  BodyJacobian<3> L = BodyJacobian<3>::Random();
  const auto blocks = spline.pull_back(time, L);
  EXPECT_EQ(blocks.first, place.first);
  const Eigen::MatrixXd expected = L * J;
  for (int m = 0; m < K; ++m) {
    const Eigen::MatrixXd block = expected.middleCols(6 * m, 6);
    EXPECT_LT((blocks.block[static_cast<std::size_t>(m)] - block).norm(), 1e-12 * (1.0 + expected.norm())) << m;
  }
}

TYPED_TEST(PoseSplines, PullBackEqualsDualNumbers) {
  expect_pull_back<TypeParam, 4>();
  expect_pull_back<TypeParam, 5>();
  expect_pull_back<TypeParam, 6>();
}

TEST(PoseSpline, BothKindsAgreeWhenAllKnotsShareOneRotation) {
  auto knots = random_knots<SE3>(5, 9, 0.4);
  for (Pose& knot : knots) knot.R = knots[0].R;
  const JointSpline<4> joint({Time{}, kSpacing, knots});
  const SplitSpline<4> split({Time{}, kSpacing, knots});
  for (const double t : {0.0, 0.21, 0.6}) {
    const Time time = Time{} + from_seconds(t);
    const BodyState a = joint.at(time), b = split.at(time);
    EXPECT_LT((a.p_w - b.p_w).norm(), 1e-12);
    EXPECT_LT((a.R_w_b - b.R_w_b).norm(), 1e-12);
    EXPECT_LT((a.v_w - b.v_w).norm(), 1e-11);
    EXPECT_LT((a.a_w - b.a_w).norm(), 1e-10);
  }
}

TEST(PoseSpline, IsATrajectory) {
  const JointSpline<4> spline({Time{}, kSpacing, random_knots<SE3>(5, 9, 0.4)});
  const Trajectory trajectory(spline);
  EXPECT_EQ(trajectory.at(Time{} + kSpacing)->p_w, spline.at(Time{} + kSpacing).p_w);
  EXPECT_TRUE(trajectory.at(trajectory.span().end).has_value());
  EXPECT_FALSE(trajectory.at(trajectory.span().end + Duration(1)).has_value());
  EXPECT_FALSE(trajectory.at(trajectory.span().begin - Duration(1)).has_value());
}

}  // namespace
}  // namespace vispline

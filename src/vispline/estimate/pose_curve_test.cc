// A curve through poses: of a motion it can follow, of noise, of gaps.
#include "vispline/estimate/pose_curve.h"

#include <gtest/gtest.h>

#include "vispline/core/error.h"
#include "vispline/core/random.h"
#include "vispline/core/so3.h"
#include "vispline/trajectory/analytic.h"

namespace vispline {
namespace {

Signal<Pose> dance(double rate_hz, double sigma) {
  const Trajectory T_w_b = analytic_trajectory("dance", Time{}, from_seconds(4.0)).value();
  const RandomStream stream(2, "poses");
  Signal<Pose> poses;
  const SampleClock clock{Time{}, rate_hz};
  for (std::int64_t i = 0; clock(i) < Time{} + from_seconds(4.0); ++i) {
    const auto z = [&](std::uint64_t k) { return sigma * stream.normal(6 * static_cast<std::uint64_t>(i) + k); };
    Pose pose = T_w_b.at(clock(i))->T_w_b();
    pose.p += Vector3d(z(0), z(1), z(2));
    pose.R = pose.R * SO3::exp<double>(Vector3d(z(3), z(4), z(5)));
    poses.push_back(clock(i), pose);
  }
  return poses;
}

TEST(PoseCurve, FollowsTheMotion) {
  const PoseCurve fit = fit_pose_curve(dance(50.0, 0.0), from_seconds(0.02), 1e-3, 1e-3);
  EXPECT_EQ(fit.curve->spacing(), from_seconds(0.02));
  EXPECT_LT(fit.position_rms_m, 1e-5);
  EXPECT_LT(fit.rotation_rms_rad, 1e-5);
  EXPECT_TRUE(fit.gaps.empty());
  const Trajectory truth = analytic_trajectory("dance", Time{}, from_seconds(4.0)).value();
  for (const double t : {0.511, 1.77, 3.203}) {
    const BodyState found = fit.curve->state({Time{} + from_seconds(t)}), state = *truth.at(Time{} + from_seconds(t));
    EXPECT_LT((found.omega_b - state.omega_b).norm(), 2e-3);
    EXPECT_LT((found.a_w - state.a_w).norm(), 0.05);
  }
}

TEST(PoseCurve, KnotsNoCloserThanAskedFor) {
  const PoseCurve fit = fit_pose_curve(dance(200.0, 1e-3), from_seconds(0.05), 1e-3, 1e-3);
  EXPECT_EQ(fit.curve->spacing(), from_seconds(0.05));
  EXPECT_NEAR(fit.position_rms_m, 1e-3 * std::sqrt(0.9), 5e-5);  // of ten numbers a knot interval one is absorbed
  EXPECT_NEAR(fit.rotation_rms_rad, 1e-3 * std::sqrt(0.9), 5e-5);
}

TEST(PoseCurve, OneOutlierMovesLittle) {
  Signal<Pose> poses = dance(50.0, 1e-4);
  poses.value[77].p += Vector3d(0.5, 0.0, 0.0);
  const PoseCurve fit = fit_pose_curve(poses, from_seconds(0.05), 1e-3, 1e-3);
  const Pose clean = analytic_trajectory("dance", Time{}, from_seconds(4.0))->at(poses.time[77])->T_w_b();
  EXPECT_LT((fit.curve->pose({poses.time[77]}).p - clean.p).norm(), 5e-3);
}

TEST(PoseCurve, GapsAreNamed) {
  const Signal<Pose> all = dance(50.0, 0.0);
  Signal<Pose> poses;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i < 60 || i > 80) poses.push_back(all.time[i], all.value[i]);
  }
  const PoseCurve fit = fit_pose_curve(poses, from_seconds(0.02), 1e-3, 1e-3);
  ASSERT_EQ(fit.gaps.size(), 1u);
  EXPECT_EQ(fit.gaps[0].begin, all.time[59]);
  EXPECT_EQ(fit.gaps[0].end, all.time[81]);
  EXPECT_TRUE(fit.in_gap(all.time[70]));
  EXPECT_FALSE(fit.in_gap(all.time[50]));
  EXPECT_FALSE(fit.in_gap(all.time[90]));
}

TEST(PoseCurve, ThreePosesAreNoMotion) {
  Signal<Pose> poses;
  for (int i = 0; i < 3; ++i) poses.push_back(time_from_ns(1'000'000 * i), Pose{});
  EXPECT_THROW(fit_pose_curve(poses, from_seconds(0.02), 1e-3, 1e-3), Error);
}

}  // namespace
}  // namespace vispline

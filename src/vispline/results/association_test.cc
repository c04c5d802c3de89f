#include "vispline/results/association.h"

#include <gtest/gtest.h>

#include <cmath>

#include "vispline/core/error.h"
#include "vispline/core/se3.h"
#include "vispline/results/gaps.h"
#include "vispline/results/pose_interpolation.h"

namespace vispline {
namespace {

Time at(double seconds) { return Time(from_seconds(seconds)); }

/// A smooth motion that turns about all axes.
Pose smooth_pose(double t) {
  const Vector3d w(0.8 * std::sin(1.1 * t), 0.5 * std::cos(0.7 * t), 0.3 * t);
  return {SO3::exp<double>(w), Vector3d(2.0 * std::cos(t), std::sin(1.3 * t), 0.5 * std::sin(2.0 * t))};
}

Signal<Pose> sampled(const std::vector<double>& seconds) {
  Signal<Pose> poses;
  for (const double s : seconds) poses.push_back(at(s), smooth_pose(s));
  return poses;
}

std::vector<double> every(double step, int n, double start = 0.0) {
  std::vector<double> seconds;
  for (int i = 0; i < n; ++i) seconds.push_back(start + step * i);
  return seconds;
}

double distance(const Pose& a, const Pose& b) { return SE3::log<double>(a.inverse() * b).norm(); }

double worst_midpoint_error(double step) {
  const int n = static_cast<int>(std::lround(6.0 / step));
  const Signal<Pose> poses = sampled(every(step, n));
  double worst = 0.0;
  for (int i = 2; i + 3 < n; ++i) {
    const double s = (i + 0.4) * step;
    worst = std::max(worst, distance(*interpolate_pose(poses, at(s), 1.0), smooth_pose(s)));
  }
  return worst;
}

TEST(PoseInterpolation, IsOfFourthOrder) {
  const double coarse = worst_midpoint_error(0.1), fine = worst_midpoint_error(0.05);
  EXPECT_LT(coarse, 5e-5);
  EXPECT_NEAR(std::log2(coarse / fine), 4.0, 0.3);
}

TEST(PoseInterpolation, IsExactAtStampsAndForConstantTwists) {
  Vector6d twist;
  twist << 0.5, -1.0, 0.3, 0.2, 0.9, -0.4;
  const Pose start = smooth_pose(1.0);
  Signal<Pose> poses;
  for (const double s : {0.0, 0.1, 0.21, 0.3, 0.9, 1.0}) poses.push_back(at(s), start * SE3::exp<double>(s * twist));
  for (const double s : {0.0, 0.05, 0.1, 0.17, 0.25, 0.6, 0.95, 1.0}) {
    EXPECT_LT(distance(*interpolate_pose(poses, at(s), 1.0), start * SE3::exp<double>(s * twist)), 1e-9) << s;
  }
}

TEST(PoseInterpolation, DoesNotDependOnTheWorldFrame) {
  const Pose T = smooth_pose(17.0);
  Signal<Pose> poses = sampled(every(0.1, 10));
  const Pose before = *interpolate_pose(poses, at(0.437), 1.0);
  for (Pose& pose : poses.value) pose = T * pose;
  EXPECT_LT(distance(*interpolate_pose(poses, at(0.437), 1.0), T * before), 1e-13);
}

TEST(PoseInterpolation, NeverBridgesGapsOrExtrapolates) {
  const Signal<Pose> poses = sampled({0.0, 0.1, 0.2, 0.9, 1.0});
  EXPECT_FALSE(interpolate_pose(poses, at(-0.001), 0.5));
  EXPECT_FALSE(interpolate_pose(poses, at(1.001), 0.5));
  EXPECT_FALSE(interpolate_pose(poses, at(0.5), 0.5));
  EXPECT_TRUE(interpolate_pose(poses, at(0.5), 0.7));
  EXPECT_TRUE(interpolate_pose(poses, at(0.2), 0.5));
  EXPECT_TRUE(interpolate_pose(poses, at(0.9), 0.5));
  EXPECT_FALSE(interpolate_pose({}, at(0.0), 0.5));
}

TEST(Association, InterpolationCountsEveryPose) {
  std::vector<double> reference_s = every(0.01, 100);
  reference_s.erase(reference_s.begin() + 30, reference_s.begin() + 60);  // no samples in (0.29, 0.60)
  const Signal<Pose> reference = sampled(reference_s), estimate = sampled(every(0.05, 30, -0.203));
  const Association found = associate(estimate, reference, {});
  EXPECT_EQ(found.estimate_outside, 5 + 6);  // -0.203 .. -0.003 and 0.997 .. 1.247
  EXPECT_EQ(found.estimate_unmatched, 7);    // 0.297 .. 0.597
  EXPECT_EQ(static_cast<std::int64_t>(found.pairs.size()) + found.estimate_outside + found.estimate_unmatched, 30);
  for (const PosePair& pair : found.pairs) EXPECT_LT(distance(pair.T_w_b_estimate, pair.T_w_b_reference), 1e-6);
}

TEST(Association, NearestIsMutualAndWithinTheTolerance) {
  const Signal<Pose> reference = sampled({0.0, 1.0, 2.0, 3.0}), estimate = sampled({0.004, 0.9, 0.95, 2.2, 3.0});
  AssociationOptions options{.mode = AssociationMode::kNearest, .tolerance_s = 0.1, .max_gap_s = {}};
  const Association found = associate(estimate, reference, options);
  ASSERT_EQ(found.pairs.size(), 3u);
  EXPECT_EQ(found.pairs[0].time, at(0.004));
  EXPECT_EQ(found.pairs[1].time, at(0.95));  // 0.9 is nearest to 1.0 as well, but farther
  EXPECT_EQ(found.pairs[2].time, at(3.0));
  EXPECT_EQ(found.estimate_unmatched, 2);
  EXPECT_EQ(found.reference_unmatched, 1);
  EXPECT_LT(distance(found.pairs[1].T_w_b_reference, smooth_pose(1.0)), 1e-15);
  options.tolerance_s = 0.0;
  EXPECT_EQ(associate(estimate, reference, options).pairs.size(), 1u);
}

TEST(Association, NothingSharedGivesNoPairs) {
  const Signal<Pose> early = sampled(every(0.1, 5)), late = sampled(every(0.1, 5, 100.0));
  for (const AssociationMode mode : {AssociationMode::kInterpolate, AssociationMode::kNearest}) {
    const Association found = associate(early, late, {.mode = mode, .tolerance_s = 0.01, .max_gap_s = {}});
    EXPECT_TRUE(found.pairs.empty());
    EXPECT_EQ(found.estimate_outside, 5);
    EXPECT_EQ(associate(early, {}, {.mode = mode, .tolerance_s = 0.01, .max_gap_s = {}}).estimate_outside, 5);
  }
  EXPECT_THROW(associate(early, late, {.mode = AssociationMode::kNearest, .tolerance_s = -1.0, .max_gap_s = {}}),
               Error);
}

TEST(Gaps, MedianAndLimit) {
  const std::vector<Time> time = {at(0.0), at(0.01), at(0.02), at(0.03), at(0.5), at(0.51)};
  EXPECT_NEAR(median_period_s(time), 0.01, 1e-12);
  EXPECT_NEAR(gap_limit_s(time, 3.0, 0.001), 0.03, 1e-12);
  EXPECT_EQ(gap_limit_s(time, 3.0, 0.1), 0.1);
  EXPECT_EQ(median_period_s({at(1.0)}), 0.0);
}

TEST(Gaps, SecondsAreExact) {
  EXPECT_EQ(seconds_text(time_from_ns(1403636579758555392)), "1403636579.758555392");
  EXPECT_EQ(seconds_text(time_from_ns(-1)), "-0.000000001");
  EXPECT_EQ(seconds_text(time_from_ns(INT64_MIN)), "-9223372036.854775808");
}

}  // namespace
}  // namespace vispline

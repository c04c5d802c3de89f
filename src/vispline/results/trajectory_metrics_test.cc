#include "vispline/results/trajectory_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "vispline/core/random.h"
#include "vispline/core/so3.h"

namespace vispline {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

Time at(double seconds) { return Time(from_seconds(seconds)); }

Pose reference_pose(double t) {
  return {SO3::exp<double>(Vector3d(0.6 * std::sin(t), 0.4 * std::cos(0.8 * t), 0.5 * t)),
          Vector3d(3.0 * std::cos(0.5 * t), 2.0 * std::sin(0.6 * t), 0.4 * t)};
}

Signal<Pose> reference_signal(double step, int n) {
  Signal<Pose> poses;
  for (int i = 0; i < n; ++i) poses.push_back(at(i * step), reference_pose(i * step));
  return poses;
}

/// The reference, moved into another world and scaled, with errors of every pose.
Signal<Pose> estimate_signal(const Signal<Pose>& reference, const Pose& T, double scale, double sigma) {
  const RandomStream random(42, "errors");
  Signal<Pose> poses = reference;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto noise = [&](std::uint64_t k) { return sigma * random.normal(6 * i + k); };
    Pose pose = T * poses.value[i];
    pose.p = scale * pose.p + Vector3d(noise(0), noise(1), noise(2));
    pose.R = pose.R * SO3::exp<double>(Vector3d(noise(3), noise(4), noise(5)));
    poses.value[i] = pose;
  }
  return poses;
}

const Pose kOtherWorld{SO3::exp<double>(Vector3d(0.7, -1.1, 2.0)), Vector3d(5.0, -8.0, 13.0)};

TEST(ErrorStatistics, HandComputed) {
  const ErrorStatistics s = error_statistics({4.0, 1.0, 2.0, 5.0});
  EXPECT_DOUBLE_EQ(s.rmse, std::sqrt(46.0 / 4.0));
  EXPECT_DOUBLE_EQ(s.mean, 3.0);
  EXPECT_DOUBLE_EQ(s.median, 3.0);
  EXPECT_DOUBLE_EQ(s.max, 5.0);
  EXPECT_DOUBLE_EQ(s.std, std::sqrt(2.5));
  EXPECT_DOUBLE_EQ(error_statistics({7.0, 1.0, 2.0}).median, 2.0);
  EXPECT_EQ(error_statistics({}).max, 0.0);
}

/// Three poses along x; the estimate is 0, 3 and 4 m off and turned by 90 degrees at the end.
TEST(CompareTrajectories, HandComputedWithoutAlignment) {
  Signal<Pose> reference, estimate;
  for (int i = 0; i < 3; ++i) reference.push_back(at(i), {Matrix3d::Identity(), Vector3d(2.0 * i, 0.0, 0.0)});
  estimate.push_back(at(0), {Matrix3d::Identity(), Vector3d(0.0, 0.0, 0.0)});
  estimate.push_back(at(1), {Matrix3d::Identity(), Vector3d(2.0, 3.0, 0.0)});
  estimate.push_back(at(2), {SO3::exp<double>(Vector3d(0.0, 0.0, 0.5 * std::numbers::pi)), Vector3d(4.0, 0.0, 4.0)});
  TrajectoryCompareOptions options;
  options.alignment = AlignmentMode::kNone;
  options.deltas = {{1.0, DeltaUnit::kSeconds}, {4.0, DeltaUnit::kMetres}, {7.0, DeltaUnit::kSeconds}};
  const TrajectoryComparison c = compare_trajectories(estimate, reference, options);
  EXPECT_NEAR(c.position_m.rmse, std::sqrt(25.0 / 3.0), 1e-12);
  EXPECT_NEAR(c.position_m.mean, 7.0 / 3.0, 1e-12);
  EXPECT_NEAR(c.position_m.median, 3.0, 1e-12);
  EXPECT_NEAR(c.position_m.max, 4.0, 1e-12);
  EXPECT_NEAR(c.rotation_rmse_deg, 90.0 / std::sqrt(3.0), 1e-9);
  EXPECT_NEAR(c.rotation_max_deg, 90.0, 1e-9);
  EXPECT_NEAR(c.path_length_m, 4.0, 1e-12);
  EXPECT_NEAR(c.duration_s, 2.0, 1e-12);
  // Relative motion over 1 s is 2 m along x; that of the estimate (2, 3, 0) and (2, -3, 4).
  EXPECT_EQ(c.relative[0].pairs, 2);
  EXPECT_NEAR(*c.relative[0].translation_rmse_m, std::sqrt((9.0 + 25.0) / 2.0), 1e-12);
  EXPECT_NEAR(*c.relative[0].rotation_rmse_deg, 90.0 / std::sqrt(2.0), 1e-9);
  EXPECT_EQ(c.relative[1].pairs, 1);
  EXPECT_NEAR(*c.relative[1].translation_rmse_m, 4.0, 1e-12);
  EXPECT_EQ(c.relative[2].pairs, 0);
  EXPECT_FALSE(c.relative[2].translation_rmse_m);
  EXPECT_TRUE(c.diagnostics.empty());
}

TEST(CompareTrajectories, AlignmentRemovesTheOtherWorld) {
  const Signal<Pose> reference = reference_signal(0.05, 400);
  const Signal<Pose> rigid = estimate_signal(reference, kOtherWorld, 1.0, 0.0);
  const Signal<Pose> scaled = estimate_signal(reference, kOtherWorld, 0.25, 0.0);
  TrajectoryCompareOptions options;
  const TrajectoryComparison se3 = compare_trajectories(rigid, reference, options);
  EXPECT_LT(se3.position_m.max, 1e-12);
  EXPECT_LT(se3.rotation_max_deg, 1e-10);
  options.alignment = AlignmentMode::kSim3;
  const TrajectoryComparison sim3 = compare_trajectories(scaled, reference, options);
  EXPECT_NEAR(sim3.alignment.scale, 4.0, 1e-12);
  EXPECT_LT(sim3.position_m.max, 1e-11);
  for (const RelativeError& error : sim3.relative) EXPECT_LT(*error.translation_rmse_m, 1e-11);
  options.alignment = AlignmentMode::kYaw;
  EXPECT_GT(compare_trajectories(rigid, reference, options).position_m.rmse, 0.1);
}

TEST(CompareTrajectories, RelativeErrorNeedsNoAlignment) {
  const Signal<Pose> reference = reference_signal(0.05, 400);
  const Signal<Pose> estimate = estimate_signal(reference, kOtherWorld, 1.0, 0.01);
  TrajectoryCompareOptions options;
  const TrajectoryComparison aligned = compare_trajectories(estimate, reference, options);
  options.alignment = AlignmentMode::kNone;
  const TrajectoryComparison raw = compare_trajectories(estimate, reference, options);
  ASSERT_EQ(raw.relative.size(), 4u);
  for (std::size_t i = 0; i < raw.relative.size(); ++i) {
    EXPECT_GT(*raw.relative[i].translation_rmse_m, 0.01);
    EXPECT_NEAR(*raw.relative[i].translation_rmse_m, *aligned.relative[i].translation_rmse_m, 1e-12);
    EXPECT_NEAR(*raw.relative[i].rotation_rmse_deg, *aligned.relative[i].rotation_rmse_deg, 1e-9);
  }
}

struct BruteForce {
  std::int64_t pairs = 0;
  double translation_rmse_m = 0.0, rotation_rmse_deg = 0.0;
};

/// The definition, with 4x4 matrices and a search over all later poses.
BruteForce brute_force(const Signal<Pose>& estimate, const Signal<Pose>& reference, RelativeDelta delta, double tol) {
  const auto matrix = [](const Pose& pose) {
    Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
    T.topLeftCorner<3, 3>() = pose.R;
    T.topRightCorner<3, 1>() = pose.p;
    return T;
  };
  BruteForce result;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    double best = 1e300, length = 0.0;
    std::size_t partner = i;
    for (std::size_t j = i + 1; j < reference.size(); ++j) {
      length += (reference.value[j].p - reference.value[j - 1].p).norm();
      const double seconds = to_seconds(reference.time[j] - reference.time[i]);
      const double miss = std::abs((delta.unit == DeltaUnit::kSeconds ? seconds : length) - delta.value);
      if (miss < best - 1e-9) {
        best = miss;
        partner = j;
      }
    }
    if (partner == i || best > tol * delta.value) continue;
    const Eigen::Matrix4d Q = matrix(reference.value[i]).inverse() * matrix(reference.value[partner]);
    const Eigen::Matrix4d P = matrix(estimate.value[i]).inverse() * matrix(estimate.value[partner]);
    const Eigen::Matrix4d E = Q.inverse() * P;
    ++result.pairs;
    result.translation_rmse_m += E.topRightCorner<3, 1>().squaredNorm();
    result.rotation_rmse_deg += std::pow(kDegrees * Eigen::AngleAxisd(Matrix3d(E.topLeftCorner<3, 3>())).angle(), 2);
  }
  result.translation_rmse_m = std::sqrt(result.translation_rmse_m / static_cast<double>(result.pairs));
  result.rotation_rmse_deg = std::sqrt(result.rotation_rmse_deg / static_cast<double>(result.pairs));
  return result;
}

TEST(CompareTrajectories, RelativeErrorMatchesTheDefinition) {
  Signal<Pose> reference;
  double t = 0.0;
  for (int i = 0; i < 300; ++i) {
    t += i % 7 == 0 ? 0.091 : 0.05;
    reference.push_back(at(t), reference_pose(i >= 100 && i < 120 ? 5.0 : t));  // stands still for a while
  }
  const Signal<Pose> estimate = estimate_signal(reference, kOtherWorld, 1.0, 0.02);
  TrajectoryCompareOptions options;
  options.alignment = AlignmentMode::kNone;
  options.deltas = {
      {0.5, DeltaUnit::kSeconds}, {3.0, DeltaUnit::kSeconds}, {0.3, DeltaUnit::kMetres}, {2.0, DeltaUnit::kMetres}};
  const TrajectoryComparison c = compare_trajectories(estimate, reference, options);
  for (const RelativeError& error : c.relative) {
    const BruteForce expected = brute_force(estimate, reference, error.delta, options.delta_tolerance);
    EXPECT_GT(error.pairs, 100);
    EXPECT_EQ(error.pairs, expected.pairs) << error.delta.value;
    EXPECT_NEAR(*error.translation_rmse_m, expected.translation_rmse_m, 1e-12) << error.delta.value;
    EXPECT_NEAR(*error.rotation_rmse_deg, expected.rotation_rmse_deg, 1e-8) << error.delta.value;
  }
}

TEST(CompareTrajectories, WarnsOfUnpairedPosesAndRefusesStrangers) {
  const Signal<Pose> reference = reference_signal(0.05, 100);
  Signal<Pose> estimate = reference_signal(0.05, 120), later = reference;
  const TrajectoryComparison c = compare_trajectories(estimate, reference);
  EXPECT_EQ(c.association.estimate_outside, 20);
  ASSERT_EQ(c.diagnostics.counts().count("W-UNPAIRED"), 1u);
  EXPECT_NE(c.diagnostics.examples()[0].message.find("20 of 120"), std::string::npos);
  for (Time& time : later.time) time += std::chrono::hours(1);
  try {
    compare_trajectories(later, reference);
    FAIL() << "expected E-OVERLAP";
  } catch (const Error& error) {
    EXPECT_EQ(error.diagnostic().code, "E-OVERLAP");
    EXPECT_EQ(error.exit_code(), ExitCode::kUnfit);
    EXPECT_NE(error.diagnostic().message.find("[3600.000000000, 3604.950000000]"), std::string::npos);
    EXPECT_NE(error.diagnostic().message.find("[0.000000000, 4.950000000]"), std::string::npos);
  }
  EXPECT_THROW(compare_trajectories({}, reference), Error);
}

}  // namespace
}  // namespace vispline

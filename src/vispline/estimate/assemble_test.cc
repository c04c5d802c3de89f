// Which readings become rows, how they are batched, and what priors weigh.
#include "vispline/estimate/assemble.h"

#include <gtest/gtest.h>

#include "vispline/core/error.h"
#include "vispline/estimate/estimate_testing.h"
#include "vispline/estimate/priors.h"

namespace vispline {
namespace {

Problem small_problem() {
  Problem problem;
  problem.start = testing::generic_state({SplineKind::kJoint, 4, from_seconds(0.1)}, 3);
  problem.parameters = parameters_of(problem.start);
  return problem;
}

std::size_t rows_of(const Problem& problem) {
  std::vector<Parameter> parameters = problem.parameters;
  const Columns columns = assign_columns(problem.start, parameters);
  std::size_t count = 0;
  Rows rows;
  for (const auto& m : problem.measurements) {
    m->evaluate(problem.start, columns, false, rows);
    count += static_cast<std::size_t>(rows.r.size());
  }
  return count;
}

TEST(Assemble, EveryImuSampleInTheSpanCountsOnce) {
  Problem problem = small_problem();
  ImuSignal signal;
  for (int i = 0; i < 120; ++i) signal.push_back(time_from_ns(7'700'000L * i), {});
  const TimeSpan span{signal.time[13], signal.time[101]};
  add_imu(problem, 0, signal, span, {1.0, 1.0}, {});
  EXPECT_EQ(rows_of(problem), 6u * 89u);
  EXPECT_EQ(problem.measurements.size(), 7u);  // 0.678 s in batches below one knot spacing
}

TEST(Assemble, PosesAndUnknownTargetPoints) {
  Problem problem = small_problem();
  Signal<Pose> poses;
  for (int i = 0; i < 30; ++i) poses.push_back(time_from_ns(100'000'000L + 20'000'000L * i), Pose{});
  add_poses(problem, 0, poses, {poses.time[0], poses.time[9]}, 1.0, 1.0, {});
  EXPECT_EQ(rows_of(problem), 60u);
  problem.measurements.clear();
  FeatureSignal features;
  features.push_back(time_from_ns(500'000'000L), {{1, {300.0, 200.0}}, {2, {310.0, 220.0}}, {99, {1.0, 1.0}}});
  add_target(problem, 0, features, {{1, Vector3d(0, 0, 3)}, {2, Vector3d(0.1, 0, 3)}}, problem.start.curve->span(), 1.0,
             {});
  EXPECT_EQ(rows_of(problem), 4u);
}

TEST(Assemble, SigmasNeedNoise) {
  Imu imu;
  imu.rate_hz = 400.0;
  imu.noise.gyro.white = 2e-4;
  EXPECT_THROW(sigma_of(imu), Error);
  imu.noise.accel.white = 1e-3;
  EXPECT_DOUBLE_EQ(sigma_of(imu).gyro, 4e-3);
  EXPECT_DOUBLE_EQ(sigma_of(imu).accel, 2e-2);
}

TEST(Assemble, TheLastTreatmentCounts) {
  Problem problem = small_problem();
  treat(problem.parameters,
        {{"cam*.T_c_b", {}}, {"cam1.T_c_b.rotation", {Role::kPrior, 0.1}}, {"cam0", {Role::kFixed}}});
  for (const Parameter& p : problem.parameters) {
    const bool prior = p.name == "cam1.T_c_b.rotation", free = p.name == "cam1.T_c_b.translation";
    if (!p.name.starts_with("cam")) continue;
    EXPECT_EQ(p.treatment.role, prior ? Role::kPrior : free ? Role::kFree : Role::kFixed) << p.name;
  }
  EXPECT_THROW(treat(problem.parameters, {{"cam7.T_c_b", {}}}), Error);
}

TEST(Priors, CostIsHalfTheSquareOfTheSigmas) {
  Problem problem = small_problem();
  treat(problem.parameters, {{"cam0.T_c_b.translation", {Role::kPrior, 0.02}}});
  add_priors(problem);
  ASSERT_EQ(problem.measurements.size(), 1u);
  const Columns columns = assign_columns(problem.start, problem.parameters);
  State state = problem.start;
  Rows rows;
  problem.measurements[0]->evaluate(state, columns, false, rows);
  EXPECT_EQ(rows.cost, 0.0);
  state.rig.cameras[0].T_c_b.p += Vector3d(0.02, -0.04, 0.0);
  problem.measurements[0]->evaluate(state, columns, false, rows);
  EXPECT_NEAR(rows.cost, 0.5 * (1.0 + 4.0), 1e-9);
}

/// A constant twist has no bends.
TEST(Priors, SteadyMotionIsSmooth) {
  Problem problem = small_problem();
  const Pose step{SO3::exp<double>(Vector3d(0.1, 0.2, -0.1)), Vector3d(0.03, -0.01, 0.02)};
  Pose pose;
  problem.start.curve = make_curve({SplineKind::kJoint, 4, from_seconds(0.1)}, {Time{}, Time{} + from_seconds(3.0)},
                                   [&](Time) { return pose = pose * step; });
  add_smoothness(problem);
  EXPECT_GE(problem.measurements.size(), 3u);
  const Columns columns = assign_columns(problem.start, problem.parameters);
  Rows rows;
  std::size_t bends = 0;
  for (const auto& m : problem.measurements) {
    m->evaluate(problem.start, columns, false, rows);
    EXPECT_LT(rows.cost, 1e-18);
    bends += static_cast<std::size_t>(rows.r.size()) / 6;
  }
  EXPECT_EQ(bends, problem.start.curve->knots() - 2);
}

}  // namespace
}  // namespace vispline

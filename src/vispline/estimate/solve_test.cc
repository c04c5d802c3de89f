// The solver on small calibrations of exact data: the answer is the truth, for every curve and any number of threads.
#include "vispline/estimate/solve.h"

#include <gtest/gtest.h>

#include "vispline/estimate/calibration_testing.h"

namespace vispline {
namespace {

using testing::SmallCalibration;

void disturb(Problem& problem) {
  Camera& camera = problem.start.rig.cameras[0];
  camera.T_c_b.R = SO3::exp<double>(Vector3d(0.04, -0.03, 0.05)) * camera.T_c_b.R;
  camera.T_c_b.p += Vector3d(0.03, -0.02, 0.01);
  camera.time_offset_s += 0.003;
  problem.start.rig.imus[0].gyroscope.bias.setZero();
  problem.start.rig.imus[0].accelerometer.bias.setZero();
}

TEST(Solve, ExactDataGiveTheTruth) {
  SmallCalibration calibration({.noise = 0.0});
  disturb(calibration.problem);
  SolveOptions options;
  options.least_decrease = 1e-16;
  options.relative_decrease = 1e-14;
  const Solution solution = solve(calibration.problem, options);
  EXPECT_EQ(solution.status, SolveStatus::kConverged);
  EXPECT_LT(solution.cost, 1e-12);
  const Rig &found = solution.state.rig, &truth = calibration.truth.rig;
  EXPECT_LT((found.cameras[0].T_c_b.p - truth.cameras[0].T_c_b.p).norm(), 1e-6);
  EXPECT_LT((found.cameras[0].T_c_b.R - truth.cameras[0].T_c_b.R).norm(), 1e-6);
  EXPECT_NEAR(found.cameras[0].time_offset_s, truth.cameras[0].time_offset_s, 1e-6);
  EXPECT_LT((found.imus[0].gyroscope.bias - truth.imus[0].gyroscope.bias).norm(), 1e-6);
  EXPECT_LT((found.imus[0].accelerometer.bias - truth.imus[0].accelerometer.bias).norm(), 1e-6);
  EXPECT_LT((solution.state.g_w - calibration.truth.g_w).norm(), 1e-6);
}

TEST(Solve, CostNeverRisesOnAcceptedSteps) {
  SmallCalibration calibration({.seed = 3});
  disturb(calibration.problem);
  const Solution solution = solve(calibration.problem, {});
  for (const IterationRow& row : solution.iterations) {
    if (row.accepted) {
      EXPECT_GT(row.decrease, 0.0) << row.iteration;
    }
  }
  EXPECT_LT(solution.cost, 0.1 * solution.first_cost);
}

TEST(Solve, SameBytesForAnyThreads) {
  std::vector<Solution> solutions;
  for (const std::size_t threads : {1, 2, 5}) {
    SmallCalibration calibration({.duration_s = 1.5});
    disturb(calibration.problem);
    SolveOptions options;
    options.threads = threads;
    solutions.push_back(solve(calibration.problem, options));
  }
  for (const Solution& other : solutions) {
    EXPECT_EQ(other.cost, solutions[0].cost);
    EXPECT_EQ(other.covariance, solutions[0].covariance);
    EXPECT_EQ(other.state.rig.cameras[0].T_c_b.R, solutions[0].state.rig.cameras[0].T_c_b.R);
  }
}

TEST(Solve, StopKeepsTheBestState) {
  SmallCalibration calibration({});
  disturb(calibration.problem);
  SolveOptions options;
  options.progress = [](const IterationRow& row) { return row.iteration < 1; };
  const Solution solution = solve(calibration.problem, options);
  EXPECT_EQ(solution.status, SolveStatus::kStopped);
  EXPECT_LT(solution.cost, solution.first_cost);
}

}  // namespace
}  // namespace vispline

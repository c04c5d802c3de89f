// Jack-knife and twin against the information matrix, on small calibrations of the model itself.
#include <gtest/gtest.h>

#include "vispline/estimate/calibration_testing.h"
#include "vispline/estimate/jackknife.h"
#include "vispline/estimate/twin.h"

namespace vispline {
namespace {

using testing::SmallCalibration;

TEST(Twin, SigmasAreRight) {
  SmallCalibration calibration({});
  const Solution solution = solve(calibration.problem, {});
  const Twin result = twin(calibration.problem, solution, {.runs = 40, .seed = 3, .threads = 2});
  EXPECT_EQ(result.failed, 0);
  EXPECT_TRUE(result.consistent()) << result.nees << " in " << result.nees_low << " to " << result.nees_high;
  EXPECT_NEAR(result.coverage, 0.95, 0.03);
  for (const ComponentSpread& c : result.components) {
    EXPECT_NEAR(c.spread / c.sigma, 1.0, 0.45) << c.label;  // four sigmas of 40 runs
  }
}

TEST(Twin, SameBytesForAnyThreads) {
  SmallCalibration calibration({.duration_s = 1.5});
  const Solution solution = solve(calibration.problem, {});
  const Twin one = twin(calibration.problem, solution, {.runs = 4, .threads = 1});
  const Twin three = twin(calibration.problem, solution, {.runs = 4, .threads = 3});
  EXPECT_EQ(one.nees, three.nees);
  const Twin other = twin(calibration.problem, solution, {.runs = 4, .seed = 2});
  EXPECT_NE(one.nees, other.nees);
}

TEST(Jackknife, AgreesWithSigmasWhereTheModelIsRight) {
  SmallCalibration calibration({});
  const Solution solution = solve(calibration.problem, {});
  const Jackknife result = jackknife(calibration.problem, solution, {.blocks = 10, .threads = 2});
  ASSERT_EQ(result.components.size(), static_cast<std::size_t>(solution.covariance.rows()));
  double log_ratio = 0.0;
  for (const ComponentSpread& c : result.components) {
    EXPECT_GT(c.spread / c.sigma, 0.3) << c.label;
    EXPECT_LT(c.spread / c.sigma, 3.0) << c.label;
    log_ratio += std::log(c.spread / c.sigma) / static_cast<double>(result.components.size());
  }
  EXPECT_NEAR(log_ratio, 0.0, 0.3);
}

}  // namespace
}  // namespace vispline

// What the unknowns absorb of each sensor's residuals, against the exact traces of a small problem.
#include "vispline/estimate/noise_estimation.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "vispline/estimate/calibration_testing.h"
#include "vispline/estimate/solve.h"

namespace vispline {
namespace {

using testing::SmallCalibration;

struct Exact {
  double rows = 0.0, absorbed = 0.0, chi2 = 0.0;
};

/// tr(J_s H^-1 J_s^T) with a dense H.
std::map<std::string, Exact> exact_fits(const Problem& problem, const Solution& solution) {
  const int n = solution.columns.layout.columns;
  std::map<std::string, Eigen::MatrixXd> H_of;
  std::map<std::string, Exact> fits;
  Rows rows;
  for (const auto& measurement : problem.measurements) {
    measurement->evaluate(solution.state, solution.columns, true, rows);
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(rows.r.size(), n);
    for (std::size_t c = 0; c < rows.column.size(); ++c) {
      J.col(rows.column[c]) += rows.J.col(static_cast<Eigen::Index>(c));
    }
    for (Eigen::Index i = 0; i < rows.r.size(); ++i) {
      const std::string name = measurement->sensors()[measurement->sensor_of(i)];
      Eigen::MatrixXd& H = H_of.try_emplace(name, Eigen::MatrixXd::Zero(n, n)).first->second;
      H += rows.weight(i) * J.row(i).transpose() * J.row(i);
      fits[name].rows += 1.0;
      fits[name].chi2 += rows.weight(i) * rows.r(i) * rows.r(i);
    }
  }
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(n, n);
  for (const auto& [name, H] : H_of) all += H;
  const Eigen::LLT<Eigen::MatrixXd> factor(all);
  for (auto& [name, fit] : fits) fit.absorbed = factor.solve(H_of.at(name)).trace();
  return fits;
}

TEST(NoiseEstimation, RedundancyIsTheExactTrace) {
  SmallCalibration calibration({.duration_s = 1.5});
  const Solution solution = solve(calibration.problem, {});
  const auto exact = exact_fits(calibration.problem, solution);
  const auto fits = sensor_fits(calibration.problem, solution.state, solution.columns, 1, 64);
  ASSERT_EQ(fits.size(), exact.size());
  double absorbed = 0.0;
  for (const auto& [name, fit] : fits) {
    const Exact& expected = exact.at(name);
    absorbed += expected.absorbed;
    EXPECT_EQ(static_cast<double>(fit.rows), expected.rows) << name;
    EXPECT_NEAR(fit.chi2, expected.chi2, 1e-9 * expected.chi2) << name;
    // Scatter of Hutchinson's estimate over 64 probes: below sqrt(2 tr / 64).
    EXPECT_NEAR(static_cast<double>(fit.rows) - fit.redundancy, expected.absorbed,
                4.0 * std::sqrt(2.0 * expected.absorbed / 64.0) + 1e-6)
        << name;
  }
  EXPECT_NEAR(absorbed, solution.columns.layout.columns, 1e-4 * absorbed);
}

TEST(NoiseEstimation, SameForAnyThreads) {
  SmallCalibration calibration({.duration_s = 1.0});
  const Solution solution = solve(calibration.problem, {});
  const auto one = sensor_fits(calibration.problem, solution.state, solution.columns, 1);
  for (const auto& [name, fit] : sensor_fits(calibration.problem, solution.state, solution.columns, 3)) {
    EXPECT_EQ(fit.redundancy, one.at(name).redundancy) << name;
  }
}

TEST(NoiseEstimation, SigmasFollowTheResiduals) {
  std::map<std::string, SensorFit> fits{{"a", {100, 400.0, 100.0}}, {"b", {100, 400.0, 1.0}}};
  double a = 0.5, b = 0.5, c = 0.5;
  rescale_sigma(a, "a", fits);
  rescale_sigma(b, "b", fits);  // hardly any redundancy
  rescale_sigma(c, "c", fits);  // not measured
  EXPECT_EQ(a, 1.0);
  EXPECT_EQ(b, 0.5);
  EXPECT_EQ(c, 0.5);
}

TEST(NoiseEstimation, FindsNoiseThatIsThreeTimesTheAssumed) {
  SmallCalibration calibration({.noise = 3.0, .seed = 4});
  const Solution solution = solve(calibration.problem, {});
  const auto fits = sensor_fits(calibration.problem, solution.state, solution.columns, 1, 16);
  for (const char* name : {"imu0.gyroscope", "imu0.accelerometer", "cam0"}) {
    const SensorFit& fit = fits.at(name);
    EXPECT_NEAR(std::sqrt(fit.chi2_per_redundancy()), 3.0, 12.0 / std::sqrt(2.0 * fit.redundancy)) << name;
  }
}

}  // namespace
}  // namespace vispline

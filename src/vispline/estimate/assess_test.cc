// The class of a result, its sigmas and its words, on small calibrations whose answer is known.
#include "vispline/estimate/assess.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "vispline/estimate/calibration_testing.h"
#include "vispline/estimate/priors.h"

namespace vispline {
namespace {

using testing::SmallCalibration;

CalibrationResult result_of(SmallCalibration& calibration, const SolveOptions& options = {}) {
  const Solution solution = solve(calibration.problem, options);
  return assess(calibration.problem, solution, {.truth = &calibration.truth});
}

CalibrationResult result_of(const SmallCalibration::Options& options) {
  SmallCalibration calibration(options);
  return result_of(calibration);
}

std::string all_words(const CalibrationResult& result) {
  std::string words(to_name(result.result_class));
  for (const std::string& reason : result.reasons) words += "\n" + reason;
  for (const WeakDirection& weak : result.weak) words += "\nweak: " + weak.words + " -> " + weak.remedy;
  return words;
}

const SensorResiduals& sensor(const CalibrationResult& result, const std::string& name) {
  return *std::find_if(result.residuals.begin(), result.residuals.end(),
                       [&](const SensorResiduals& r) { return r.sensor == name; });
}

TEST(Assess, GoodDataConverge) {
  SmallCalibration calibration({});
  const CalibrationResult result = result_of(calibration);
  EXPECT_EQ(result.result_class, ResultClass::kConverged) << all_words(result);
  EXPECT_LT(result.gradient_sigmas, 0.05);
  EXPECT_NEAR(result.curvature_low, 1.0, 0.05);
  EXPECT_NEAR(result.curvature_high, 1.0, 0.05);
  ASSERT_TRUE(result.nees);
  EXPECT_NEAR(*result.nees, 1.0, 4.0 * std::sqrt(2.0 / static_cast<double>(result.correlation.rows())));
  ASSERT_FALSE(result.parameters.empty());
  EXPECT_EQ(result.parameters.back().name, "cam0.time_offset");
  for (const EstimatedParameter& p : result.parameters) {
    for (const ParameterComponent& c : p.components) {
      ASSERT_TRUE(c.error) << p.name;
      EXPECT_LT(std::abs(*c.error), 4.0 * c.sigma) << p.name << " " << c.name;
      EXPECT_GT(c.sigma, 0.0) << p.name;
    }
  }
  for (const SensorResiduals& r : result.residuals) {
    EXPECT_NEAR(r.chi2_per_dof, 1.0, 4.0 * std::sqrt(2.0 / r.dof)) << r.sensor;
    EXPECT_GT(r.lag1, r.lag1_low) << r.sensor;
    EXPECT_LT(r.lag1, r.lag1_high) << r.sensor;
  }
  EXPECT_EQ(sensor(result, "imu0.gyroscope").count, 900);
  EXPECT_NEAR(sensor(result, "cam0").rms, SmallCalibration::kPixelSigma, 0.03);
}

/// What all sensors absorb together is the number of unknowns.
TEST(Assess, DegreesOfFreedomAddUp) {
  SmallCalibration calibration({});
  const Solution solution = solve(calibration.problem, {});
  const CalibrationResult result = assess(calibration.problem, solution);
  double absorbed = 0.0;
  for (const SensorResiduals& r : result.residuals) absorbed += static_cast<double>(r.count) - r.dof;
  EXPECT_NEAR(absorbed, solution.columns.layout.columns, 0.1 * solution.columns.layout.columns);
}

TEST(Assess, WrongSigmasAreInconsistent) {
  const CalibrationResult loud = result_of(SmallCalibration::Options{.noise = 3.0});
  EXPECT_EQ(loud.result_class, ResultClass::kInconsistent);
  EXPECT_NE(all_words(loud).find("cam0: residuals are"), std::string::npos) << all_words(loud);
  EXPECT_EQ(result_of(SmallCalibration::Options{.noise = 0.2}).result_class, ResultClass::kInconsistent);
}

TEST(Assess, FewIterationsAreNotConverged) {
  SmallCalibration calibration({});
  calibration.problem.start.rig.cameras[0].T_c_b.p += Vector3d(0.05, 0.0, 0.0);
  const CalibrationResult result = result_of(calibration, {.max_iterations = 1});
  EXPECT_EQ(result.result_class, ResultClass::kNotConverged) << all_words(result);
  EXPECT_EQ(exit_code_of(result.result_class), 5);
}

TEST(Assess, StoppedKeepsTheClass) {
  SmallCalibration calibration({});
  calibration.problem.start.rig.cameras[0].T_c_b.p += Vector3d(0.05, 0.0, 0.0);
  const CalibrationResult result = result_of(calibration, {.progress = [](const IterationRow&) { return false; }});
  EXPECT_EQ(result.result_class, ResultClass::kStopped);
  EXPECT_EQ(exit_code_of(result.result_class), 130);
}

/// Turning about z alone does not show how far apart camera and IMU are along z.
TEST(Assess, LeverArmAlongTheOnlyAxisOfRotation) {
  const CalibrationResult result = result_of(SmallCalibration::Options{.turn = 0.0});
  ASSERT_FALSE(result.weak.empty()) << all_words(result);
  EXPECT_NE(result.result_class, ResultClass::kConverged);
  EXPECT_NE(all_words(result).find("cam0.T_c_i.translation along z"), std::string::npos) << all_words(result);
  EXPECT_NE(all_words(result).find("turn faster about x and y"), std::string::npos) << all_words(result);
}

/// The offset of an IMU without samples.
TEST(Assess, WhatNothingMeasuresIsNamed) {
  SmallCalibration calibration({});
  Imu imu = calibration.truth.rig.imus[0];
  imu.name = "imu1";
  calibration.truth.rig.imus.push_back(imu);
  calibration.problem.start.rig.imus.push_back(imu);
  std::vector<Parameter> parameters = parameters_of(calibration.problem.start);
  for (const Parameter& old : calibration.problem.parameters) {
    for (Parameter& parameter : parameters) {
      if (parameter.name == old.name) parameter.treatment = old.treatment;
    }
  }
  find_parameters(parameters, "imu1.time_offset").front()->treatment.role = Role::kFree;
  calibration.problem.parameters = parameters;
  const CalibrationResult result = result_of(calibration);
  EXPECT_EQ(result.result_class, ResultClass::kRankDeficient) << all_words(result);
  ASSERT_EQ(result.weak.size(), 1u) << all_words(result);
  EXPECT_EQ(result.weak[0].words, "imu1.time_offset");
  EXPECT_FALSE(result.weak[0].measured);
}

Parameter& parameter(SmallCalibration& calibration, const std::string& name) {
  return *find_parameters(calibration.problem.parameters, name).front();
}

/// A held offset that is 2 ms wrong: the residuals tell which one, and where it should go.
TEST(Assess, HeldParameterThatIsWrong) {
  SmallCalibration calibration({});
  const double truth_s = calibration.truth.rig.cameras[0].time_offset_s;
  parameter(calibration, "cam0.time_offset").treatment.role = Role::kFixed;
  calibration.problem.start.rig.cameras[0].time_offset_s = truth_s + 2e-3;
  const CalibrationResult result = result_of(calibration);
  ASSERT_FALSE(result.held.empty());
  const HeldParameter& worst = result.held.front();
  EXPECT_EQ(worst.name, "cam0.time_offset");
  EXPECT_GT(worst.share, 0.1);
  ASSERT_EQ(worst.change.size(), 1u);
  EXPECT_NEAR(worst.change[0], -2e-3, 4.0 * worst.sigma[0] + 1e-4);
  EXPECT_EQ(result.diagnostics.counts().at("W-HELD"), 1);
}

TEST(Assess, HeldParametersThatAreRightAreNotNamed) {
  SmallCalibration calibration({});
  parameter(calibration, "cam0.time_offset").treatment.role = Role::kFixed;
  EXPECT_TRUE(result_of(calibration).held.empty());
}

TEST(Assess, SameBytesForAnyThreads) {
  SmallCalibration calibration({});
  const Solution solution = solve(calibration.problem, {});
  const CalibrationResult one = assess(calibration.problem, solution, {.threads = 1});
  const CalibrationResult three = assess(calibration.problem, solution, {.threads = 3});
  EXPECT_EQ(one.gradient_sigmas, three.gradient_sigmas);
  for (std::size_t i = 0; i < one.residuals.size(); ++i) EXPECT_EQ(one.residuals[i].dof, three.residuals[i].dof);
}

}  // namespace
}  // namespace vispline

#include "vispline/integrate/rules.h"

#include <gtest/gtest.h>

#include <map>

#include "vispline/core/error.h"
#include "vispline/integrate/ellipse_testing.h"

namespace vispline {
namespace {

using testing_support::ellipse_error;
using testing_support::ReckoningError;

/// Published with as many digits as the tolerance says; ellipse, 20 s, 200 Hz, samples at both ends.
struct Reference {
  std::string_view rule;
  double final_m, final_tolerance_m;
  double max_m, max_tolerance_m;
  double rms_m, rms_tolerance_m;
  double max_deg, deg_tolerance;
};

constexpr Reference kAt200Hz[] = {
    {"euler_course_2018", 0.5766, 5e-5, 0.5766, 5e-5, 0.3066, 5e-5, 5.4e-2, 5e-4},
    {"euler_course", 1.0423, 5e-5, 1.0423, 5e-5, 0.4823, 5e-5, 5.4e-2, 5e-4},
    {"euler", 0.9062, 5e-5, 0.9062, 5e-5, 0.3917, 5e-5, 5.4e-2, 5e-4},
    {"midpoint_course_report", 0.4688, 5e-5, 0.4688, 5e-5, 0.2079, 5e-5, 2.3e-4, 5e-6},
    {"midpoint_course_report_position_first", 0.4685, 5e-5, 0.4685, 5e-5, 0.1890, 6e-5, 2.3e-4, 5e-6},
    {"midpoint_course_report_normalized", 0.00129, 5e-6, 0.0690, 5e-5, 0.0459, 5e-5, 2.3e-4, 5e-6},
    {"midpoint_small_angle", 0.001294, 6e-7, 0.00131, 5e-6, 0.000748, 5e-7, 2.3e-4, 5e-6},
    {"midpoint", 0.001286, 5e-7, 0.00130, 5e-6, 0.000743, 5e-7, 1.3e-4, 5e-6},
    {"midpoint_coning", 0.00132, 5e-6, 0.00133, 5e-6, 0.00075, 5e-6, 6.8e-5, 5e-7},
    {"rk4", 0.001253, 5e-7, 0.00125, 5e-6, 0.000719, 5e-7, 6.8e-5, 5e-7},
    {"piecewise_linear_exact", 0.00125, 5e-6, 0.00125, 5e-6, 0.00072, 5e-6, 6.8e-5, 5e-7},
};

TEST(Rules, ErrorsOnTheEllipseAt200HzAreThePublishedOnes) {
  for (const Reference& expected : kAt200Hz) {
    const ReckoningError error = ellipse_error(expected.rule, 200);
    EXPECT_NEAR(error.final_m, expected.final_m, expected.final_tolerance_m) << expected.rule;
    EXPECT_NEAR(error.max_m, expected.max_m, expected.max_tolerance_m) << expected.rule;
    EXPECT_NEAR(error.rms_m, expected.rms_m, expected.rms_tolerance_m) << expected.rule;
    EXPECT_NEAR(error.max_deg, expected.max_deg, expected.deg_tolerance) << expected.rule;
  }
}

struct FinalError {
  std::string_view rule;
  double rate_hz, final_m, tolerance_m;
};

constexpr FinalError kAtOtherRates[] = {
    {"euler_course", 50, 4.168, 5e-4},
    {"euler_course", 100, 2.084, 5e-4},
    {"euler_course", 400, 0.5212, 5e-5},
    {"euler_course", 1000, 0.2085, 5e-5},
    {"euler", 50, 3.621, 5e-4},
    {"euler", 100, 1.812, 5e-4},
    {"euler", 400, 0.4532, 5e-5},
    {"euler", 1000, 0.1813, 5e-5},
    {"midpoint", 50, 0.02058, 5e-6},
    {"midpoint", 100, 0.00515, 5e-6},
    {"midpoint", 400, 0.000322, 5e-7},
    {"midpoint", 1000, 0.000051, 5e-7},
    {"midpoint_small_angle", 50, 0.02071, 5e-6},
    {"midpoint_small_angle", 100, 0.00518, 5e-6},
    {"midpoint_small_angle", 400, 0.000324, 5e-7},
    {"midpoint_small_angle", 1000, 0.000052, 5e-7},
    {"rk4", 50, 0.02004, 5e-6},
    {"rk4", 100, 0.00501, 5e-6},
    {"rk4", 400, 0.000313, 5e-7},
    {"rk4", 1000, 0.000050, 5e-7},
    {"midpoint_lagged", 100, 0.284, 5e-4},
    {"midpoint_lagged", 200, 0.1416, 5e-5},
    {"midpoint_lagged", 400, 0.071, 5e-4},
};

TEST(Rules, ErrorsOnTheEllipseAtOtherRatesAreThePublishedOnes) {
  for (const FinalError& expected : kAtOtherRates) {
    EXPECT_NEAR(ellipse_error(expected.rule, expected.rate_hz).final_m, expected.final_m, expected.tolerance_m)
        << expected.rule << " at " << expected.rate_hz << " Hz";
  }
}

TEST(Rules, EveryRuleConvergesAtTheOrderItClaims) {
  for (const IntegrationRule& rule : integration_rules()) {
    const double coarse = ellipse_error(rule.name, 100).max_m, fine = ellipse_error(rule.name, 400).max_m;
    EXPECT_NEAR(std::log2(coarse / fine) / 2, rule.order, 0.05) << rule.name;
  }
}

TEST(Rules, CubicInterpolationBreaksTheSecondOrderFloor) {
  EXPECT_LT(ellipse_error("rk4_cubic", 200).final_m, 1e-6);
  double previous = ellipse_error("rk4_cubic", 50).max_m;
  for (const double rate_hz : {100.0, 200.0, 400.0}) {
    const double now = ellipse_error("rk4_cubic", rate_hz).max_m;
    EXPECT_GT(std::log2(previous / now), 3.7) << rate_hz;
    previous = now;
  }
}

/// docs/math/integrate.md (18): what repeated multiplication by [1, theta/2] does to the norm.
double norm_after_raw_turns(const ImuSignal& imu) {
  double norm = 1.0;
  for (std::size_t i = 0; i + 1 < imu.size(); ++i) {
    const SampleWindow window(imu, i);
    norm *= std::sqrt(1.0 + (0.25 * window.dt() * (window.first().gyro + window.last().gyro)).squaredNorm());
  }
  return norm;
}

TEST(Rules, OnlyTheRawQuaternionRulesLoseTheUnitNorm) {
  const Trajectory ellipse = *analytic_trajectory("ellipse", Time{}, std::chrono::seconds(20));
  const auto imu = testing_support::exact_samples(ellipse, testing_support::regular_stamps(20, 200));
  const double grown = norm_after_raw_turns(imu);
  EXPECT_NEAR(grown, 1.00163, 5e-6);
  for (const std::string& name : rule_names()) {
    const auto states = dead_reckon(imu, nav_state(*ellipse.at(Time{})), name, testing_support::kGravityW);
    const bool raw = name == "midpoint_course_report" || name == "midpoint_course_report_position_first";
    const double expected = raw || name == "euler_course_2018" ? grown : 1.0;
    EXPECT_NEAR(states.value.back().q_w_b.norm(), expected, raw || expected == 1.0 ? 1e-12 : 1e-7) << name;
  }
}

TEST(Rules, NamesAreUniqueAndAnUnknownOneListsThem) {
  std::map<std::string, int> count;
  for (const std::string& name : rule_names()) EXPECT_EQ(++count[name], 1) << name;
  EXPECT_EQ(count.size(), 13u);
  EXPECT_EQ(integration_rule("rk4").name, "rk4");
  try {
    integration_rule("midpiont");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::kUsage);
    EXPECT_NE(std::string(error.what()).find("'midpiont'"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("rk4_cubic"), std::string::npos);
  }
}

}  // namespace
}  // namespace vispline

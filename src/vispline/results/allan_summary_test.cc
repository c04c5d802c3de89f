#include "vispline/results/allan_summary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "vispline/results/allan_result_testing.h"
#include "vispline/results/allan_words.h"

namespace vispline {
namespace {

TEST(AllanSummary, GroupsTheAxesOfASensor) {
  const auto sensors = summarize(synthetic_allan_result());
  ASSERT_EQ(sensors.size(), 2u);
  EXPECT_EQ(sensors[0].sensor, "gyroscope");
  EXPECT_EQ(sensors[1].unit, "m/s^2");
  EXPECT_EQ(sensors[1].signals, (std::vector<std::size_t>{3, 4, 5}));
  EXPECT_TRUE(sensors[0][Term::kWhite].resolved());
  EXPECT_NEAR(*sensors[1][Term::kFlicker].mean, 4e-4, 1e-18);
  EXPECT_EQ(sensors[1][Term::kFlicker].worst_axis, "x");
}

TEST(AllanSummary, ABoundMayExceedEveryResolvedAxis) {
  const auto sensors = summarize(synthetic_allan_result());
  const TermSummary& gyroscope = sensors[0][Term::kRandomWalk];
  EXPECT_DOUBLE_EQ(gyroscope.worst.value(), 2.5e-6);
  EXPECT_EQ(gyroscope.limit(), 3.1e-6);
  EXPECT_EQ(gyroscope.unresolved_axes, (std::vector<std::string>{"z"}));
  EXPECT_DOUBLE_EQ(sensors[1][Term::kRandomWalk].limit().value(), 2.6e-5);
  EXPECT_EQ(sensors[1][Term::kRandomWalk].record_needed_s, 43200.0);
}

TEST(AllanSummary, AnAxisWithoutABoundLeavesNoBoundForTheSensor) {
  AllanResult result = synthetic_allan_result();
  result.signals[0].terms[Term::kFlicker].upper_bound.reset();
  EXPECT_FALSE(summarize(result)[0][Term::kFlicker].upper_bound);
  EXPECT_FALSE(summarize(result)[0][Term::kFlicker].limit());
  std::swap(result.signals[0], result.signals[1]);
  EXPECT_FALSE(summarize(result)[0][Term::kFlicker].upper_bound) << "in any order of the axes";
}

TEST(AllanSummary, AxesThatNeverChangeCountForNothing) {
  const auto sensors = summarize(odd_allan_result());
  const TermSummary& white = sensors[0][Term::kWhite];
  EXPECT_FALSE(white.resolved());
  EXPECT_FALSE(white.mean || white.worst || white.limit());
  EXPECT_FALSE(sensors[0].imu_utils_n);
  AllanResult result = synthetic_allan_result();
  const double mean = 0.5 * (result.signals[1].imu_utils.n + result.signals[2].imu_utils.n);
  result.signals[0].constant = true;
  EXPECT_EQ(summarize(result)[0].imu_utils_n, mean);
}

TEST(AllanSummary, ImuUtilsAveragesOnlyWhatAllAxesHave) {
  AllanResult result = synthetic_allan_result();
  result.signals[1].imu_utils.w = 0.0;
  EXPECT_FALSE(summarize(result)[0].imu_utils_w);
  EXPECT_TRUE(summarize(result)[0].imu_utils_n);
}

TEST(AllanSummary, DiscreteSigmas) {
  EXPECT_EQ(discrete_sigma(Term::kWhite, 2.0, 100.0), 20.0);
  EXPECT_EQ(discrete_sigma(Term::kRandomWalk, 2.0, 100.0), 0.2);
  EXPECT_FALSE(discrete_sigma(Term::kFlicker, 2.0, 100.0));
  EXPECT_FALSE(discrete_sigma(Term::kWhite, std::nullopt, 100.0));
}

TEST(AllanSummary, ABoundIsUsefulIfItLiesBelowTheEndOfTheCurve) {
  SignalAnalysis signal = synthetic_allan_result().signals[0];
  const AllanCurve& curve = signal.curves[0];
  signal.terms[Term::kQuantization] = bounded_term(0.9 * curve.value.front() * 0.005 / std::sqrt(3.0), 1.0);
  EXPECT_TRUE(useful_bound(signal, Term::kQuantization));
  signal.terms[Term::kQuantization] = bounded_term(1.1 * curve.value.front() * 0.005 / std::sqrt(3.0), 1.0);
  EXPECT_FALSE(useful_bound(signal, Term::kQuantization));
  signal.terms[Term::kRamp] = bounded_term(0.9 * curve.value.back() * std::sqrt(2.0) / curve.tau_s.back(), 1.0);
  EXPECT_TRUE(useful_bound(signal, Term::kRamp));
  signal.curves.clear();
  EXPECT_FALSE(useful_bound(signal, Term::kRamp));
}

TEST(AllanSummary, TermsAreHeldAgainstAnAllanDeviationOnly) {
  SignalAnalysis signal = synthetic_allan_result().signals[0];
  signal.curves[0].deviation = Deviation::kHdev;
  EXPECT_EQ(fitted_curve(signal), nullptr);
  signal.curves.push_back(signal.curves[0]);
  signal.curves[1].deviation = Deviation::kAdev;
  EXPECT_EQ(fitted_curve(signal), &signal.curves[1]);
}

TEST(AllanWords, Durations) {
  EXPECT_EQ(duration_text(2.54), "2.5 s");
  EXPECT_EQ(duration_text(119.0), "119 s");
  EXPECT_EQ(duration_text(4500.0), "75 min");
  EXPECT_EQ(duration_text(50400.0), "14 h");
  EXPECT_EQ(duration_text(432000.0), "5 days");
}

TEST(AllanWords, Numbers) {
  EXPECT_EQ(scientific_text(1.7e-4), "1.70e-04");
  EXPECT_EQ(scientific_text(2.0, 2), "2.0e+00") << "a point, or Kalibr's parser reads a text";
  EXPECT_EQ(scientific_text(std::nullopt), "-");
  EXPECT_EQ(scientific_text(HUGE_VAL), "-");
  EXPECT_EQ(percent_text(0.567), "0.57");
  EXPECT_EQ(percent_text(5.67), "5.7");
  EXPECT_EQ(percent_text(56.7), "57");
  EXPECT_EQ(percent_text(9.96), "10");
  EXPECT_EQ(percent_text(1234.0), "1234");
}

TEST(AllanWords, KalibrKeysAndUnits) {
  EXPECT_EQ(kalibr_key("gyroscope", Term::kRandomWalk), "gyroscope_random_walk");
  EXPECT_EQ(kalibr_key("accelerometer", Term::kFlicker), "");
  EXPECT_EQ(quantity_name("series", Term::kWhite), "series N");
  EXPECT_EQ(curve_unit(Deviation::kTdev, "rad/s"), "rad");
  EXPECT_EQ(curve_unit(Deviation::kMdev, "rad/s"), "rad/s");
}

TEST(AllanWords, QuantizationAndRampAreMentionedOnlyWithAUsefulBound) {
  AllanResult result = synthetic_allan_result();
  EXPECT_EQ(unresolved_terms(result, summarize(result)[0]),
            (std::vector<Term>{Term::kRandomWalk, Term::kFlicker, Term::kQuantization, Term::kRamp}));
  for (SignalAnalysis& signal : result.signals) signal.terms[Term::kRamp].upper_bound = 1e3;
  EXPECT_EQ(unresolved_terms(result, summarize(result)[0]),
            (std::vector<Term>{Term::kRandomWalk, Term::kFlicker, Term::kQuantization}));
}

}  // namespace
}  // namespace vispline

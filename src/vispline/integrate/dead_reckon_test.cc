#include "vispline/integrate/dead_reckon.h"

#include <gtest/gtest.h>

#include <map>

#include "vispline/core/error.h"
#include "vispline/core/random.h"
#include "vispline/integrate/ellipse_testing.h"
#include "vispline/integrate/rules.h"

namespace vispline {
namespace {

using testing_support::kGravityW;

class EveryRule : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(DeadReckon, EveryRule, testing::ValuesIn(rule_names()),
                         [](const auto& test) { return test.param; });

Trajectory dance() { return *analytic_trajectory("dance", Time{}, std::chrono::seconds(10)); }

/// Mean rate_hz, every stamp displaced by up to a third of a period.
std::vector<Time> jittered_stamps(double seconds, double rate_hz) {
  const RandomStream random(7, "jitter");
  std::vector<Time> times = testing_support::regular_stamps(seconds, rate_hz);
  for (std::size_t i = 1; i + 1 < times.size(); ++i) {
    times[i] += from_seconds((random.uniform_pair(i)[0] - 0.5) / 1.5 / rate_hz);
  }
  return times;
}

TEST_P(EveryRule, KeepsALevelBodyAtRest) {
  ImuSignal imu;
  for (int i = 0; i < 50; ++i) imu.push_back(time_from_ns(5'000'000 * i), {Vector3d::Zero(), -kGravityW});
  const NavState end = dead_reckon(imu, {}, GetParam(), kGravityW).value.back();
  EXPECT_LT(end.p_w.norm() + end.v_w.norm() + end.q_w_b.vec().norm(), 1e-15);
}

TEST_P(EveryRule, HasOneStatePerSampleAndStartsAtTheStart) {
  const std::vector<Time> times = jittered_stamps(10, 20);
  const NavState start = nav_state(*dance().at(Time{}));
  const auto states = dead_reckon(testing_support::exact_samples(dance(), times), start, GetParam(), kGravityW);
  EXPECT_EQ(states.time, times);
  EXPECT_EQ(states.value.size(), times.size());
  EXPECT_EQ(states.value.front().q_w_b.coeffs(), start.q_w_b.coeffs());
}

TEST_P(EveryRule, TakesShortSignals) {
  const ImuSignal all = testing_support::exact_samples(dance(), jittered_stamps(10, 20));
  for (std::size_t n = 0; n < 5; ++n) {
    ImuSignal imu;
    for (std::size_t i = 0; i < n; ++i) imu.push_back(all.time[i], all.value[i]);
    EXPECT_EQ(dead_reckon(imu, {}, GetParam(), kGravityW).size(), n);
  }
}

bool has_raw_quaternion(std::string_view rule) {
  return rule == "euler_course_2018" || rule == "midpoint_course_report" ||
         rule == "midpoint_course_report_position_first";
}

/// Nothing in the physics knows where the world's origin is, or where north is, or how fast the world moves. A
/// quaternion that is not of unit norm does: its error (s^2 - 1)(R - 1) f depends on north.
TEST_P(EveryRule, CommutesWithYawTranslationAndVelocityOfTheWorld) {
  const ImuSignal imu = testing_support::exact_samples(dance(), jittered_stamps(10, 50));
  const Eigen::Quaterniond yaw(Eigen::AngleAxisd(0.7, Vector3d::UnitZ()));
  const Vector3d shift(3, -2, 5), speed(0.4, -0.1, 0.2);
  const NavState start{Eigen::Quaterniond(0.8, 0.1, -0.5, 0.3).normalized(), {1, 2, 3}, {0.1, 0.2, 0.3}};
  const NavState moved{yaw * start.q_w_b, yaw * start.p_w + shift, yaw * start.v_w + speed};
  const NavState end = dead_reckon(imu, start, GetParam(), kGravityW).value.back();
  const NavState moved_end = dead_reckon(imu, moved, GetParam(), kGravityW).value.back();
  const Vector3d p_w = yaw * end.p_w + shift + speed * imu.span().seconds();
  if (has_raw_quaternion(GetParam())) {
    EXPECT_GT((moved_end.p_w - p_w).norm(), 1e-2);
  } else {
    EXPECT_LT((moved_end.p_w - p_w).norm(), 1e-10);
    EXPECT_LT((moved_end.v_w - (yaw * end.v_w + speed)).norm(), 1e-11);
  }
  EXPECT_LT((moved_end.T_w_b().R - yaw * end.T_w_b().R).norm(), 1e-12);
}

TEST(DeadReckon, IrregularStampsKeepTheOrder) {
  const auto error = [](std::string_view rule, double rate_hz) {
    return testing_support::reckoning_error(dance(), jittered_stamps(10, rate_hz), rule).max_m;
  };
  EXPECT_GT(std::log2(error("midpoint", 100) / error("midpoint", 400)) / 2, 1.8);
  EXPECT_GT(std::log2(error("rk4_cubic", 100) / error("rk4_cubic", 400)) / 2, 3.5);
  EXPECT_LT(error("rk4_cubic", 400), 1e-6);
}

/// Constant body rate and specific force: the attitude is exp(omega t) in closed form.
TEST(DeadReckon, ConstantRateTurnsExactlyUnderTheExponential) {
  const ImuSample sample{{0.3, -1.2, 2.1}, {1, 2, 3}};
  ImuSignal imu;
  for (int i = 0; i <= 100; ++i) imu.push_back(time_from_ns(10'000'000 * i), sample);
  const Matrix3d R = SO3::exp<double>(sample.gyro);
  for (const std::string rule : {"euler", "midpoint", "midpoint_coning"}) {
    EXPECT_LT((dead_reckon(imu, {}, rule, kGravityW).value.back().T_w_b().R - R).norm(), 1e-13) << rule;
  }
}

TEST(DeadReckon, PosesAreNormalisedEvenWhereTheQuaternionIsNot) {
  const ImuSignal imu = testing_support::exact_samples(dance(), testing_support::regular_stamps(10, 50));
  const auto states = dead_reckon(imu, {}, "midpoint_course_report", kGravityW);
  EXPECT_GT(states.value.back().q_w_b.norm(), 1.001);
  const auto T_w_b = poses(states);
  EXPECT_EQ(T_w_b.time, imu.time);
  const Matrix3d R = T_w_b.value.back().R;
  EXPECT_LT((R.transpose() * R - Matrix3d::Identity()).norm(), 1e-14);
  EXPECT_EQ(T_w_b.value.back().p, states.value.back().p_w);
}

TEST(DeadReckon, StampsThatDoNotIncreaseAreAnError) {
  ImuSignal imu;
  for (const int ns : {0, 10, 10, 20}) imu.push_back(time_from_ns(ns), {});
  EXPECT_THROW(dead_reckon(imu, {}, "midpoint", kGravityW), Error);
}

}  // namespace
}  // namespace vispline

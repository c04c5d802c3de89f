#include "vispline/integrate/preintegration.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "vispline/core/error.h"
#include "vispline/core/random.h"
#include "vispline/integrate/ellipse_testing.h"

namespace vispline {
namespace {

using testing_support::kGravityW;
using namespace preintegration_tangent;
using Vector15 = Eigen::Matrix<double, kSize, 1>;

const NavState kSomewhere{Eigen::Quaterniond(0.7, 0.2, -0.4, 0.5).normalized(), {1, -2, 3}, {0.5, 1.5, -0.3}};
const ImuBias kBias{{0.02, -0.03, 0.05}, {0.2, -0.1, 0.3}};
const ImuNoise kNoise{{.white = 3e-3, .walk = 4e-3}, {.white = 2e-2, .walk = 5e-2}};

/// The dance from its second second on, at stamps of uneven distance.
ImuSignal dance_samples(double seconds, double rate_hz) {
  const Trajectory dance = *analytic_trajectory("dance", Time{}, std::chrono::seconds(60));
  const RandomStream random(11, "stamps");
  std::vector<Time> times = testing_support::regular_stamps(seconds, rate_hz);
  for (std::size_t i = 0; i < times.size(); ++i) {
    times[i] += std::chrono::seconds(2) + from_seconds((random.uniform_pair(i)[0] - 0.5) * 0.5 / rate_hz);
  }
  return testing_support::exact_samples(dance, times);
}

/// How far b is from a, as the tangent of Preintegration says.
Eigen::Matrix<double, kMotion, 1> motion_difference(const Preintegration& a, const Preintegration& b) {
  Eigen::Matrix<double, kMotion, 1> d;
  d << SO3::log<double>(a.delta_R_b0_b1.transpose() * b.delta_R_b0_b1), b.delta_v_b0 - a.delta_v_b0,
      b.delta_p_b0 - a.delta_p_b0;
  return d;
}

double difference(const NavState& a, const NavState& b) {
  return (a.p_w - b.p_w).norm() + (a.v_w - b.v_w).norm() + (a.T_w_b().R - b.T_w_b().R).norm();
}

ImuBias shifted(ImuBias bias, int axis, double h) {
  (axis < 3 ? bias.gyro[axis] : bias.accel[axis - 3]) += h;
  return bias;
}

TEST(Preintegration, PredictsWhatMidpointDeadReckoningArrivesAt) {
  const ImuSignal imu = dance_samples(3, 100);
  const NavState end = dead_reckon(imu, kSomewhere, "midpoint", kGravityW).value.back();
  EXPECT_LT(difference(predict(preintegrate(imu, imu.span()), kSomewhere, kGravityW), end), 1e-12);
}

TEST(Preintegration, SubtractsTheBias) {
  const ImuSignal clean = dance_samples(1, 100);
  ImuSignal biased = clean;
  for (ImuSample& sample : biased.value) sample = {sample.gyro + kBias.gyro, sample.accel + kBias.accel};
  const Preintegration a = preintegrate(clean, clean.span()), b = preintegrate(biased, clean.span(), kBias);
  EXPECT_LT(motion_difference(a, b).norm(), 1e-13);
  EXPECT_GT(motion_difference(a, preintegrate(biased, clean.span())).norm(), 0.1);
}

TEST(Preintegration, BiasJacobianAgreesWithIntegratingAgain) {
  const ImuSignal imu = dance_samples(1, 100);
  const auto J = preintegrate(imu, imu.span(), kBias).bias_jacobian;
  constexpr double kStep = 1e-5;
  for (int axis = 0; axis < 6; ++axis) {
    const Preintegration minus = preintegrate(imu, imu.span(), shifted(kBias, axis, -kStep));
    const Preintegration plus = preintegrate(imu, imu.span(), shifted(kBias, axis, kStep));
    const auto column = (motion_difference(minus, plus) / (2 * kStep)).eval();
    EXPECT_LT((J.col(axis) - column).norm(), 1e-7 * column.norm()) << axis;
  }
}

TEST(Preintegration, CorrectionIsFirstOrderInTheBias) {
  const ImuSignal imu = dance_samples(1, 100);
  const Preintegration at_zero = preintegrate(imu, imu.span());
  const auto error = [&](double scale) {
    const ImuBias bias{scale * kBias.gyro, scale * kBias.accel};
    return motion_difference(corrected(at_zero, bias), preintegrate(imu, imu.span(), bias)).norm();
  };
  EXPECT_LT(error(1e-2), 1e-6);
  EXPECT_NEAR(error(0.2) / error(0.1), 4.0, 0.2);
}

TEST(Preintegration, PartsComposeToTheWhole) {
  const ImuSignal imu = dance_samples(2, 100);
  const Time middle = imu.time[83];
  const Preintegration first = preintegrate(imu, {imu.time.front(), middle}, kBias, kNoise);
  const Preintegration second = preintegrate(imu, {middle, imu.time.back()}, kBias, kNoise);
  const Preintegration whole = preintegrate(imu, imu.span(), kBias, kNoise), both = compose(first, second);
  EXPECT_LT(motion_difference(whole, both).norm(), 1e-13);
  EXPECT_LT((whole.bias_jacobian - both.bias_jacobian).norm(), 1e-12 * whole.bias_jacobian.norm());
  EXPECT_LT((whole.covariance - both.covariance).norm(), 1e-12 * whole.covariance.norm());
  EXPECT_EQ(to_ns(both.span.end), to_ns(whole.span.end));
  EXPECT_THROW(compose(second, first), Error);
}

TEST(Preintegration, StampsBetweenSamplesAreInterpolated) {
  ImuSignal imu;  // linear in time, so that a line through two samples is exact
  for (int i = 0; i <= 10; ++i) imu.push_back(time_from_ns(100'000'000 * i), {Vector3d::Zero(), {0.1 * i, 0, 2}});
  const TimeSpan span{time_from_ns(130'000'000), time_from_ns(770'000'000)};
  const Preintegration motion = preintegrate(imu, span);
  EXPECT_NEAR(motion.delta_v_b0.x(), 0.5 * (0.77 * 0.77 - 0.13 * 0.13), 1e-15);
  EXPECT_NEAR(motion.delta_v_b0.z(), 2 * 0.64, 1e-15);
  EXPECT_NEAR(motion.delta_p_b0.z(), 0.64 * 0.64, 1e-15);
}

/// A body at rest: the textbook growth N^2 t, N^2 t^3/3, K^2 t, K^2 t^3/3.
TEST(Preintegration, CovarianceAtRestFollowsTheTextbook) {
  ImuSignal imu;
  for (int i = 0; i <= 2000; ++i) imu.push_back(time_from_ns(1'000'000 * i), {});
  const auto P = preintegrate(imu, imu.span(), {}, kNoise).covariance;
  const auto square = [](double x) { return x * x; };
  const double gyro_angle = square(kNoise.gyro.white) * 2 + square(kNoise.gyro.walk) * 8 / 3;
  EXPECT_NEAR(P(kRotation, kRotation), gyro_angle, 2e-3 * gyro_angle);
  const double velocity = square(kNoise.accel.white) * 2 + square(kNoise.accel.walk) * 8 / 3;
  EXPECT_NEAR(P(kVelocity + 1, kVelocity + 1), velocity, 2e-3 * velocity);
  const double position = square(kNoise.accel.white) * 8 / 3 + square(kNoise.accel.walk) * 32 / 20;
  EXPECT_NEAR(P(kPosition + 2, kPosition + 2), position, 2e-3 * position);
  EXPECT_NEAR(P(kGyroBias, kGyroBias), square(kNoise.gyro.walk) * 2, 1e-15);
  EXPECT_NEAR(P(kAccelBias, kAccelBias), square(kNoise.accel.walk) * 2, 1e-12);
}

/// `clean` as an instrument with kNoise would have read it, and its biases at the last sample.
std::pair<ImuSignal, ImuBias> noisy(const ImuSignal& clean, int run, double rate_hz) {
  const RandomStream random(2024, "preintegration");
  std::uint64_t counter = static_cast<std::uint64_t>(run) << 20;
  const auto normals = [&] {
    return Vector3d(random.normal(counter), random.normal(counter + 1), random.normal(counter + 2));
  };
  const auto draw = [&](double sigma) {
    const Vector3d x = sigma * normals();
    counter += 3;
    return x;
  };
  std::pair<ImuSignal, ImuBias> result{clean, {}};
  auto& [imu, bias] = result;
  for (std::size_t i = 0; i < imu.size(); ++i) {
    if (i > 0) {
      const double root_dt = std::sqrt(to_seconds(imu.time[i] - imu.time[i - 1]));
      bias.gyro += draw(kNoise.gyro.walk * root_dt);
      bias.accel += draw(kNoise.accel.walk * root_dt);
    }
    imu.value[i].gyro += bias.gyro + draw(kNoise.gyro.white * std::sqrt(rate_hz));
    imu.value[i].accel += bias.accel + draw(kNoise.accel.white * std::sqrt(rate_hz));
  }
  return result;
}

constexpr int kRuns = 600;

/// Truth minus preintegration for kRuns noisy readings of one motion.
std::vector<Vector15> monte_carlo_errors(const ImuSignal& clean, double rate_hz) {
  const Preintegration truth = preintegrate(clean, clean.span());
  std::vector<Vector15> errors;
  for (int run = 0; run < kRuns; ++run) {
    const auto [imu, bias] = noisy(clean, run, rate_hz);
    Vector15 error;
    error << motion_difference(preintegrate(imu, imu.span()), truth), bias.gyro, bias.accel;
    errors.push_back(error);
  }
  return errors;
}

/// Chi-square bounds at five standard deviations, plus the half-weight of the two end samples (1 in 60).
TEST(Preintegration, CovarianceIsThatOfAMonteCarlo) {
  const Trajectory dance = *analytic_trajectory("dance", Time{}, std::chrono::seconds(5));
  const ImuSignal clean = testing_support::exact_samples(dance, testing_support::regular_stamps(1.2, 50));
  const auto P = preintegrate(clean, clean.span(), {}, kNoise).covariance;
  const Eigen::LLT<Preintegration::Covariance> cholesky(P);
  ASSERT_EQ(cholesky.info(), Eigen::Success);
  double nees = 0.0;
  Vector15 variance = Vector15::Zero();
  for (const Vector15& error : monte_carlo_errors(clean, 50)) {
    nees += cholesky.matrixL().solve(error).squaredNorm() / (kRuns * kSize);
    variance += error.cwiseAbs2() / kRuns;
  }
  EXPECT_NEAR(nees, 1.0, 5 * std::sqrt(2.0 / (kRuns * kSize)) + 1.0 / 60);
  for (int i = 0; i < kSize; ++i) EXPECT_NEAR(variance[i] / P(i, i), 1.0, 5 * std::sqrt(2.0 / kRuns) + 1.0 / 60) << i;
}

TEST(Preintegration, SpansWithoutSamplesAreErrors) {
  const ImuSignal imu = dance_samples(0.1, 100);
  EXPECT_THROW(preintegrate({}, imu.span()), Error);
  EXPECT_THROW(preintegrate(imu, {imu.time[3], imu.time[3]}), Error);
  EXPECT_THROW(preintegrate(imu, {imu.time[0] - Duration(1), imu.time[3]}), Error);
  EXPECT_THROW(preintegrate(imu, {imu.time[0], imu.time.back() + Duration(1)}), Error);
  ImuSignal repeated = imu;
  repeated.time[4] = repeated.time[5];
  EXPECT_THROW(preintegrate(repeated, imu.span()), Error);
}

}  // namespace
}  // namespace vispline

// The rotation of a body from its gyroscope, against the motion that it measured.
#include "vispline/estimate/gyro_rotation.h"

#include <gtest/gtest.h>

#include "vispline/core/so3.h"
#include "vispline/trajectory/analytic.h"

namespace vispline {
namespace {

const Vector3d kBias(0.01, -0.02, 0.015);

ImuSignal exact_imu(const Trajectory& T_w_b, double rate_hz) {
  ImuSignal imu;
  const SampleClock clock{T_w_b.span().begin, rate_hz};
  for (std::int64_t i = 0; clock(i) <= T_w_b.span().end; ++i) {
    const BodyState s = *T_w_b.at(clock(i));
    imu.push_back(clock(i), {s.omega_b + kBias, s.R_w_b.transpose() * (s.a_w + Vector3d(0.0, 0.0, 9.81))});
  }
  return imu;
}

/// Of second order in the step: a trapezoid of the rate.
TEST(GyroRotation, FollowsTheBody) {
  const Trajectory T_w_b = analytic_trajectory("dance", Time{}, from_seconds(5.0)).value();
  double error[2];
  for (int i = 0; i < 2; ++i) {
    const GyroRotation R_w_b(exact_imu(T_w_b, 100.0 * (i + 1)), kBias, 0.05);
    const Matrix3d R = R_w_b(Time{} + from_seconds(1.3)).transpose() * R_w_b(Time{} + from_seconds(4.7));
    const Matrix3d truth =
        T_w_b.at(Time{} + from_seconds(1.3))->R_w_b.transpose() * T_w_b.at(Time{} + from_seconds(4.7))->R_w_b;
    error[i] = SO3::log<double>(Matrix3d(R.transpose() * truth)).norm();
  }
  EXPECT_LT(error[0], 2e-3);
  EXPECT_LT(error[1], 0.4 * error[0]);
}

TEST(GyroRotation, StartsLevel) {
  const Pose tilted{SO3::exp<double>(Vector3d(0.5, -0.8, 0.0)), Vector3d::Zero()};
  ImuSignal imu;
  for (int i = 0; i < 50; ++i) {
    imu.push_back(time_from_ns(10'000'000L * i), {Vector3d::Zero(), tilted.R.transpose() * Vector3d(0.0, 0.0, 9.81)});
  }
  const GyroRotation R_w_b(imu, Vector3d::Zero());
  EXPECT_LT((R_w_b(Time{}).transpose() * Vector3d::UnitZ() - tilted.R.transpose() * Vector3d::UnitZ()).norm(), 1e-12);
}

TEST(GyroRotation, BetweenAndBeyondSamples) {
  ImuSignal imu;
  const Vector3d omega(0.3, -0.5, 0.7), up(0.0, 0.0, 9.81);
  for (int i = 0; i < 3; ++i) imu.push_back(time_from_ns(100'000'000L * i), {omega, up});
  const GyroRotation R_w_b(imu, Vector3d::Zero(), 0.0);
  for (const double t : {0.0, 0.05, 0.13, 0.2}) {
    const Matrix3d expected = SO3::exp<double>(Vector3d(t * omega));
    EXPECT_LT((R_w_b(Time{} + from_seconds(t)) - expected).norm(), 1e-12) << t;
  }
  EXPECT_EQ(R_w_b(Time{} - from_seconds(1.0)), R_w_b(Time{}));
  EXPECT_EQ(R_w_b(Time{} + from_seconds(9.0)), R_w_b(Time{} + from_seconds(0.2)));
}

}  // namespace
}  // namespace vispline

#include "vispline/integrate/preintegration.h"

#include <algorithm>
#include <functional>

#include "vispline/core/error.h"
#include "vispline/core/so3.h"

namespace vispline {
namespace {

using namespace preintegration_tangent;
using MotionMatrix = Eigen::Matrix<double, kMotion, kMotion>;

ImuSample interpolate(const ImuSample& first, const ImuSample& last, double u) {
  return {(1.0 - u) * first.gyro + u * last.gyro, (1.0 - u) * first.accel + u * last.accel};
}

/// Precondition: time is inside imu.span().
ImuSample sample_at(const ImuSignal& imu, Time time) {
  const auto after = std::ranges::lower_bound(imu.time, time);
  const auto i = static_cast<std::size_t>(after - imu.time.begin());
  if (*after == time) return imu.value[i];
  const double u = to_seconds(time - imu.time[i - 1]) / to_seconds(imu.time[i] - imu.time[i - 1]);
  return interpolate(imu.value[i - 1], imu.value[i], u);
}

/// The samples inside the span (so that many short spans of a long signal stay cheap), with interpolated ones at its
/// ends where there are none.
ImuSignal cut(const ImuSignal& imu, TimeSpan span) {
  ImuSignal result;
  result.push_back(span.begin, sample_at(imu, span.begin));
  auto i = static_cast<std::size_t>(std::ranges::upper_bound(imu.time, span.begin) - imu.time.begin());
  for (; imu.time[i] < span.end; ++i) result.push_back(imu.time[i], imu.value[i]);
  result.push_back(span.end, sample_at(imu, span.end));
  return result;
}

/// Densities per step of dt: the mean of white noise has the variance N^2/dt, a random walk grows by K^2 dt.
Vector6d gyro_accel(double gyro, double accel) {
  Vector6d values;
  values << Vector3d::Constant(gyro), Vector3d::Constant(accel);
  return values;
}

/// d (rotation, velocity, position) / d bias of one step, equation (6).
Preintegration::BiasJacobian step_jacobian(const Matrix3d& E, const Vector3d& theta_b, const Vector3d& f_end,
                                           double dt) {
  Preintegration::BiasJacobian J = Preintegration::BiasJacobian::Zero();
  const Matrix3d right_jacobian = SO3::left_jacobian<double>(-theta_b);
  const Matrix3d rotation = -dt * right_jacobian;
  J.block<3, 3>(kRotation, 0) = rotation;
  J.block<3, 3>(kVelocity, 0) = -0.5 * dt * E * hat(f_end) * rotation;
  J.block<3, 3>(kVelocity, 3) = -0.5 * dt * (Matrix3d::Identity() + E);
  J.middleRows<3>(kPosition) = 0.5 * dt * J.middleRows<3>(kVelocity);
  return J;
}

/// Equation (8): white noise enters like a bias, the random walk adds to the bias itself.
Preintegration::Covariance step_covariance(const Preintegration::BiasJacobian& J, const ImuNoise& noise, double dt) {
  const Vector6d white = gyro_accel(noise.gyro.white, noise.accel.white);
  const Vector6d walk = gyro_accel(noise.gyro.walk, noise.accel.walk);
  Preintegration::Covariance P = Preintegration::Covariance::Zero();
  P.topLeftCorner<kMotion, kMotion>() = J * (white.cwiseAbs2() / dt).asDiagonal() * J.transpose();
  P.bottomRightCorner<6, 6>() = (walk.cwiseAbs2() * dt).asDiagonal();
  return P;
}

/// One midpoint step from sample i to sample i + 1, equations (3)-(5).
Preintegration step(const ImuSignal& imu, std::size_t i, const ImuBias& bias, const ImuNoise& noise) {
  const ImuSample &first = imu.value[i], &last = imu.value[i + 1];
  const double dt = to_seconds(imu.time[i + 1] - imu.time[i]);
  const Vector3d theta_b = (0.5 * (first.gyro + last.gyro) - bias.gyro) * dt;
  const Vector3d f_begin = first.accel - bias.accel, f_end = last.accel - bias.accel;
  Preintegration motion{.span = {imu.time[i], imu.time[i + 1]}, .bias = bias};
  motion.delta_R_b0_b1 = SO3::exp<double>(theta_b);
  motion.delta_v_b0 = 0.5 * dt * (f_begin + motion.delta_R_b0_b1 * f_end);
  motion.delta_p_b0 = 0.5 * dt * motion.delta_v_b0;
  motion.bias_jacobian = step_jacobian(motion.delta_R_b0_b1, theta_b, f_end, dt);
  motion.covariance = step_covariance(motion.bias_jacobian, noise, dt);
  return motion;
}

/// How the error of the first part reaches the whole, A of equation (10).
MotionMatrix first_to_whole(const Preintegration& first, const Preintegration& second) {
  const Matrix3d& R = first.delta_R_b0_b1;
  MotionMatrix A = MotionMatrix::Identity();
  A.block<3, 3>(kRotation, kRotation) = second.delta_R_b0_b1.transpose();
  A.block<3, 3>(kVelocity, kRotation) = -R * hat(second.delta_v_b0);
  A.block<3, 3>(kPosition, kRotation) = -R * hat(second.delta_p_b0);
  A.block<3, 3>(kPosition, kVelocity) = second.span.seconds() * Matrix3d::Identity();
  return A;
}

/// How the error of the second part reaches the whole, B of equation (10).
MotionMatrix second_to_whole(const Preintegration& first) {
  MotionMatrix B = MotionMatrix::Identity();
  B.block<3, 3>(kVelocity, kVelocity) = first.delta_R_b0_b1;
  B.block<3, 3>(kPosition, kPosition) = first.delta_R_b0_b1;
  return B;
}

/// F P F^T with F = (A C; 0 I), equation (11), block by block.
Preintegration::Covariance moved(const Preintegration::Covariance& P, const MotionMatrix& A,
                                 const Preintegration::BiasJacobian& C) {
  const Eigen::Matrix<double, kMotion, kSize> AP = A * P.topRows<kMotion>() + C * P.bottomRows<6>();
  Preintegration::Covariance result = P;
  result.topLeftCorner<kMotion, kMotion>() = AP.leftCols<kMotion>() * A.transpose() + AP.rightCols<6>() * C.transpose();
  result.topRightCorner<kMotion, 6>() = AP.rightCols<6>();
  result.bottomLeftCorner<6, kMotion>() = AP.rightCols<6>().transpose();
  return result;
}

}  // namespace

Preintegration compose(const Preintegration& first, const Preintegration& second) {
  require(first.span.end == second.span.begin, "two spans of which the second begins where the first ends");
  const Matrix3d& R = first.delta_R_b0_b1;
  const double dt = second.span.seconds();
  const MotionMatrix A = first_to_whole(first, second), B = second_to_whole(first);
  const Preintegration::BiasJacobian no_bias = Preintegration::BiasJacobian::Zero();
  Preintegration whole{.span = {first.span.begin, second.span.end}, .bias = first.bias};
  whole.delta_R_b0_b1 = R * second.delta_R_b0_b1;
  whole.delta_v_b0 = first.delta_v_b0 + R * second.delta_v_b0;
  whole.delta_p_b0 = first.delta_p_b0 + dt * first.delta_v_b0 + R * second.delta_p_b0;
  whole.bias_jacobian = A * first.bias_jacobian + B * second.bias_jacobian;
  whole.covariance = moved(first.covariance, A, B * second.bias_jacobian) + moved(second.covariance, B, no_bias);
  return whole;
}

Preintegration preintegrate(const ImuSignal& imu, TimeSpan span, const ImuBias& bias, const ImuNoise& noise) {
  require(span.begin < span.end, "a span of positive length to preintegrate");
  require(!imu.empty() && imu.time.front() <= span.begin && span.end <= imu.time.back(),
          "IMU samples from the begin to the end of the span to preintegrate");
  const ImuSignal samples = cut(imu, span);
  require(std::ranges::adjacent_find(samples.time, std::greater_equal<>()) == samples.time.end(),
          "IMU stamps that strictly increase");
  Preintegration motion{.span = {span.begin, span.begin}, .bias = bias};
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) motion = compose(motion, step(samples, i, bias, noise));
  return motion;
}

Preintegration corrected(const Preintegration& motion, const ImuBias& bias) {
  Vector6d change;
  change << bias.gyro - motion.bias.gyro, bias.accel - motion.bias.accel;
  const Eigen::Matrix<double, kMotion, 1> delta = motion.bias_jacobian * change;
  Preintegration result = motion;
  result.bias = bias;
  result.delta_R_b0_b1 = motion.delta_R_b0_b1 * SO3::exp<double>(delta.segment<3>(kRotation));
  result.delta_v_b0 += delta.segment<3>(kVelocity);
  result.delta_p_b0 += delta.segment<3>(kPosition);
  return result;
}

NavState predict(const Preintegration& motion, const NavState& start, const Vector3d& g_w) {
  const double dt = motion.span.seconds();
  return {(start.q_w_b * Eigen::Quaterniond(motion.delta_R_b0_b1)).normalized(),
          start.p_w + dt * start.v_w + 0.5 * dt * dt * g_w + start.q_w_b * motion.delta_p_b0,
          start.v_w + dt * g_w + start.q_w_b * motion.delta_v_b0};
}

}  // namespace vispline

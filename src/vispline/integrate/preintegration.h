/// Preintegration: the IMU samples between two instants as one relative motion, independent of where it started, with
/// its covariance and its first-order dependence on the biases. docs/math/preintegration.md.
#pragma once

#include "vispline/core/noise.h"
#include "vispline/core/time.h"
#include "vispline/integrate/nav_state.h"
#include "vispline/sensors/recording.h"

namespace vispline {

/// Subtracted from every sample; in frame i, which is the body here.
struct ImuBias {
  Vector3d gyro = Vector3d::Zero();   ///< rad/s
  Vector3d accel = Vector3d::Zero();  ///< m/s^2
};

/// Offsets of the error state: rotation on the right, delta_R exp(rotation); everything else additive.
namespace preintegration_tangent {
inline constexpr int kRotation = 0;    ///< rad, frame b1
inline constexpr int kVelocity = 3;    ///< m/s, frame b0
inline constexpr int kPosition = 6;    ///< m, frame b0
inline constexpr int kMotion = 9;      ///< size of the three blocks above
inline constexpr int kGyroBias = 9;    ///< rad/s, at the end of the span
inline constexpr int kAccelBias = 12;  ///< m/s^2, at the end of the span
inline constexpr int kSize = 15;
}  // namespace preintegration_tangent

/// Motion from body b0 at the begin of the span to body b1 at its end, seen by a body that falls freely from b0.
struct Preintegration {
  using BiasJacobian = Eigen::Matrix<double, preintegration_tangent::kMotion, 6>;
  using Covariance = Eigen::Matrix<double, preintegration_tangent::kSize, preintegration_tangent::kSize>;

  TimeSpan span;
  ImuBias bias;  ///< at which the samples were integrated
  Matrix3d delta_R_b0_b1 = Matrix3d::Identity();
  Vector3d delta_v_b0 = Vector3d::Zero();             ///< m/s
  Vector3d delta_p_b0 = Vector3d::Zero();             ///< m
  BiasJacobian bias_jacobian = BiasJacobian::Zero();  ///< d (rotation, velocity, position) / d (gyro, accel bias)
  /// Of (truth minus this), tangent above. The bias block is what the random walk adds within the span; its effect on
  /// the motion is included. Without walk the upper left 9 x 9 block is that of the white noise alone.
  Covariance covariance = Covariance::Zero();
};

/// Samples between the stamps of `span` by the midpoint rule; a stamp between two samples is interpolated linearly.
/// Throws Error unless the samples cover a span of positive length with stamps that strictly increase.
Preintegration preintegrate(const ImuSignal& imu, TimeSpan span, const ImuBias& bias = {}, const ImuNoise& noise = {});

/// Two spans that follow each other, as one: equations (9)-(11). Throws Error if the second does not begin where the
/// first ends. Both must have been integrated at the same bias; the result keeps that of the first.
Preintegration compose(const Preintegration& first, const Preintegration& second);

/// The same samples at another bias, to first order in the change; Jacobian and covariance are kept. Equation (12).
Preintegration corrected(const Preintegration& motion, const ImuBias& bias);

/// The state at the end of the span from that at its begin. g_w points down, m/s^2. Equation (13).
NavState predict(const Preintegration& motion, const NavState& start, const Vector3d& g_w);

}  // namespace vispline

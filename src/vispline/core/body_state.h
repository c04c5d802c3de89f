/// The waist: all that a sensor on the body can ask of a trajectory, and all that a trajectory has to answer.
/// docs/conventions.md, Frames; docs/math/spline.md for the tangent.
#pragma once

#include "vispline/core/pose.h"
#include "vispline/core/types.h"

namespace vispline {

/// State of body b in world w at one instant.
template <class T>
struct BodyStateT {
  Matrix3<T> R_w_b = Matrix3<T>::Identity();
  Vector3<T> p_w = Vector3<T>::Zero();      ///< m
  Vector3<T> v_w = Vector3<T>::Zero();      ///< m/s
  Vector3<T> omega_b = Vector3<T>::Zero();  ///< rad/s, vee(R_w_b^T dR_w_b/dt)
  Vector3<T> a_w = Vector3<T>::Zero();      ///< m/s^2, kinematic: gravity is not in it
  Vector3<T> alpha_b = Vector3<T>::Zero();  ///< rad/s^2, d omega_b / dt

  PoseT<T> T_w_b() const { return {R_w_b, p_w}; }

  template <class U>
  BodyStateT<U> cast() const {
    return {R_w_b.template cast<U>(),   p_w.template cast<U>(), v_w.template cast<U>(),
            omega_b.template cast<U>(), a_w.template cast<U>(), alpha_b.template cast<U>()};
  }
};

using BodyState = BodyStateT<double>;

/// Offsets of the blocks of a BodyState tangent. The pose is perturbed on the right, T_w_b exp(position, rotation),
/// so the position block is in frame b; velocity and acceleration (frame w) and the rates (frame b) are additive.
namespace body_tangent {
inline constexpr int kPosition = 0;
inline constexpr int kRotation = 3;
inline constexpr int kVelocity = 6;
inline constexpr int kOmega = 9;
inline constexpr int kAcceleration = 12;
inline constexpr int kAlpha = 15;
inline constexpr int kSize = 18;
}  // namespace body_tangent

using BodyTangent = Eigen::Matrix<double, body_tangent::kSize, 1>;
/// d prediction / d state: as many rows as the prediction, 18 columns.
template <int kRows>
using BodyJacobian = Eigen::Matrix<double, kRows, body_tangent::kSize>;

}  // namespace vispline

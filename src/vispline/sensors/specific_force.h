/// Specific force at a point of the body: what an ideal accelerometer feels, and what a gyroscope's mass responds to.
#pragma once

#include "vispline/core/body_state.h"
#include "vispline/core/so3.h"

namespace vispline {

/// Specific force at the origin of frame i, which is rigid on body b at T_b_i = (R_b_i, p_b_i).
///   f_i = R_i_b (R_b_w (a_w - g_w) + alpha_b x p_b_i + omega_b x (omega_b x p_b_i))       docs/math/imu.md (4)
/// m/s^2 in frame i. g_w points down: at rest with z up the force is (0, 0, +9.81). Never fails.
template <class T>
Vector3<T> specific_force(const BodyStateT<T>& state, const PoseT<T>& T_b_i, const Vector3<T>& g_w) {
  const Vector3<T>& p_b_i = T_b_i.p;
  const Vector3<T> f_b = state.R_w_b.transpose() * (state.a_w - g_w) + state.alpha_b.cross(p_b_i) +
                         state.omega_b.cross(state.omega_b.cross(p_b_i));
  return T_b_i.R.transpose() * f_b;
}

/// Specific force with its derivatives. The pose T_b_i is perturbed on the right by (translation, rotation).
struct SpecificForceLinearization {
  Vector3d f_i;
  BodyJacobian<3> d_state;
  Eigen::Matrix<double, 3, 6> d_T_b_i;
  Matrix3d d_g_w;
};

/// docs/math/imu.md (8)-(12).
SpecificForceLinearization linearize_specific_force(const BodyState& state, const Pose& T_b_i, const Vector3d& g_w);

}  // namespace vispline

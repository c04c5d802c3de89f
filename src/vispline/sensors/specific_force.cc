#include "vispline/sensors/specific_force.h"

namespace vispline {

SpecificForceLinearization linearize_specific_force(const BodyState& state, const Pose& T_b_i, const Vector3d& g_w) {
  using namespace body_tangent;
  const Matrix3d R_i_b = T_b_i.R.transpose(), R_i_w = (state.R_w_b * T_b_i.R).transpose();
  const Vector3d& p_b_i = T_b_i.p;
  const Vector3d& omega_b = state.omega_b;
  const Vector3d at_body = state.R_w_b.transpose() * (state.a_w - g_w);
  const Vector3d omega_cross_p = omega_b.cross(p_b_i);
  const Matrix3d Omega = hat(omega_b), P = hat(p_b_i);

  SpecificForceLinearization out;
  out.f_i = R_i_b * (at_body + state.alpha_b.cross(p_b_i) + omega_b.cross(omega_cross_p));
  out.d_state.setZero();
  out.d_state.middleCols<3>(kRotation) = R_i_b * hat(at_body);
  out.d_state.middleCols<3>(kOmega) = -R_i_b * (hat(omega_cross_p) + Omega * P);
  out.d_state.middleCols<3>(kAcceleration) = R_i_w;
  out.d_state.middleCols<3>(kAlpha) = -R_i_b * P;
  out.d_T_b_i.leftCols<3>() = R_i_b * (hat(state.alpha_b) + hat_squared(omega_b)) * T_b_i.R;
  out.d_T_b_i.rightCols<3>() = hat(out.f_i);
  out.d_g_w = -R_i_w;
  return out;
}

}  // namespace vispline

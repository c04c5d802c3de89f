#include "vispline/sensors/gyroscope.h"

namespace vispline {

Linearization<3, Gyroscope::kParams> Gyroscope::linearize(const BodyState& state, const BodyTangent& state_rate,
                                                          const Params<double>& params, const Vector3d& g_w) {
  const Matrix3d M_g = triad_matrix(params.scale, params.misalignment), R_i_b = params.T_b_i.R.transpose();
  const Vector3d omega_i = R_i_b * state.omega_b;
  Linearization<3, kParams> out;
  out.d_state.setZero();
  out.d_g_w.setZero();
  Eigen::Matrix<double, 3, 6> d_T_b_i = Eigen::Matrix<double, 3, 6>::Zero();
  Vector3d f_i;
  if (params.g_sensitivity.isZero(0.0)) {
    f_i = specific_force(state, params.T_b_i, g_w);
  } else {
    const SpecificForceLinearization force = linearize_specific_force(state, params.T_b_i, g_w);
    f_i = force.f_i;
    out.d_state = params.g_sensitivity * force.d_state;
    out.d_g_w = params.g_sensitivity * force.d_g_w;
    d_T_b_i = params.g_sensitivity * force.d_T_b_i;
  }
  out.prediction = M_g * omega_i + params.g_sensitivity * f_i + params.bias;
  out.d_state.middleCols<3>(body_tangent::kOmega) += M_g * R_i_b;
  d_T_b_i.rightCols<3>() += M_g * hat(omega_i);
  out.d_params << d_T_b_i, Matrix3d(omega_i.asDiagonal()), d_triad_d_misalignment(omega_i),
      f_i.x() * Matrix3d::Identity(), f_i.y() * Matrix3d::Identity(), f_i.z() * Matrix3d::Identity(),
      Matrix3d::Identity(), out.d_state * state_rate;
  return out;
}

}  // namespace vispline

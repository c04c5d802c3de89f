#include "vispline/sensors/accelerometer.h"

namespace vispline {

Linearization<3, Accelerometer::kParams> Accelerometer::linearize(const BodyState& state, const BodyTangent& state_rate,
                                                                  const Params<double>& params, const Vector3d& g_w) {
  const Matrix3d M = triad_matrix(params.scale, params.misalignment);
  const SpecificForceLinearization force = linearize_specific_force(state, params.T_b_i, g_w);

  Linearization<3, kParams> out;
  out.prediction = M * force.f_i + params.bias;
  out.d_state = M * force.d_state;
  out.d_params << M * force.d_T_b_i, Matrix3d(force.f_i.asDiagonal()), d_triad_d_misalignment(force.f_i),
      Matrix3d::Identity(), out.d_state * state_rate;
  out.d_g_w = M * force.d_g_w;
  return out;
}

}  // namespace vispline

/// A prediction and its derivatives with respect to everything it depends on.
#pragma once

#include "vispline/core/body_state.h"

namespace vispline {

/// kParams: tangent columns of all parameter blocks together, in the order of the sensor's kBlocks.
template <int kRows, int kParams>
struct Linearization {
  Eigen::Matrix<double, kRows, 1> prediction;
  BodyJacobian<kRows> d_state;                     ///< columns: core/body_state.h, body_tangent
  Eigen::Matrix<double, kRows, kParams> d_params;  ///< columns of block i start at tangent_offset(kBlocks, i)
  Eigen::Matrix<double, kRows, 3> d_g_w;
};

}  // namespace vispline

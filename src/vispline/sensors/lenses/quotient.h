/// The projections of the form m = (x, y) / denominator(point): all but the equidistant one.
#pragma once

#include "vispline/sensors/lenses/stage.h"

namespace vispline::lenses {

/// m and its derivatives from those of the denominator, which must be positive. docs/math/camera.md (3)
template <int kParams>
PlanePoint<3, kParams> quotient(const Vector3d& point_c, double denominator, const Vector3d& d_point,
                                const Eigen::Matrix<double, 1, kParams>& d_params) {
  const double scale = 1.0 / denominator;
  PlanePoint<3, kParams> result;
  result.m = scale * point_c.head<2>();
  const Vector2d slope = -scale * result.m;
  result.d_input.noalias() = slope * d_point.transpose();
  result.d_input(0, 0) += scale;
  result.d_input(1, 1) += scale;
  if constexpr (kParams > 0) result.d_params.noalias() = slope * d_params;
  return result;
}

}  // namespace vispline::lenses

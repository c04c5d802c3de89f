/// Whether an accelerometer's axes are those of the gyroscope beside it. docs/math/estimate.md, Start values.
#pragma once

#include <string>
#include <vector>

#include "vispline/core/types.h"

namespace vispline {

/// What an accelerometer felt while its body was turned by R_w_b and moved with a_w.
struct FeltForce {
  Matrix3d R_w_b;
  Vector3d a_w;  ///< m/s^2, kinematic
  Vector3d f_b;  ///< m/s^2, as read
};

/// a_w - R_w_b f_b is gravity, so it stands still. Of all 48 orders and signs of the axes: the one with which it stands
/// stillest, as the rows of a matrix; the identity unless another leaves less than half of its spread (a median).
struct AxesChoice {
  Matrix3d axes = Matrix3d::Identity();
  std::string words = "x, y, z";    ///< "-z, y, x": the axis that each reading seems to be
  Vector3d g_w = Vector3d::Zero();  ///< median with the axes as they are, m/s^2
};
AxesChoice accelerometer_axes(const std::vector<FeltForce>& felt);

}  // namespace vispline

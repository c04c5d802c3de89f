/// Three sensitive axes that are neither equally long nor square to each other: M = I + diag(scale) + misalignment.
#pragma once

#include "vispline/core/types.h"

namespace vispline {

/// Off-diagonal terms row by row: (xy, xz, yx, yz, zx, zy); `xy` is what axis x reads of the true y.
///       [1 + s_x  m_xy     m_xz   ]
///   M = [m_yx     1 + s_y  m_yz   ]                                                      docs/math/imu.md (5)
///       [m_zx     m_zy     1 + s_z]
template <class T>
Matrix3<T> triad_matrix(const Vector3<T>& scale, const Vector6<T>& misalignment) {
  Matrix3<T> M;
  M << T(1) + scale[0], misalignment[0], misalignment[1],  //
      misalignment[2], T(1) + scale[1], misalignment[3],   //
      misalignment[4], misalignment[5], T(1) + scale[2];
  return M;
}

/// d(M u) / d misalignment, 3x6.
inline Eigen::Matrix<double, 3, 6> d_triad_d_misalignment(const Vector3d& u) {
  Eigen::Matrix<double, 3, 6> J = Eigen::Matrix<double, 3, 6>::Zero();
  J(0, 0) = J(2, 5) = u.y();
  J(0, 1) = J(1, 3) = u.z();
  J(1, 2) = J(2, 4) = u.x();
  return J;
}

}  // namespace vispline

/// The tangent plane of a sphere: where the direction of a vector moves.
#pragma once

#include "vispline/core/types.h"

namespace vispline {

/// Two unit vectors across v and across each other. Precondition: v is not zero.
inline Eigen::Matrix<double, 3, 2> plane_across(const Vector3d& v) {
  const Vector3d n = v.normalized();
  Eigen::Index least = 0;
  n.cwiseAbs().minCoeff(&least);
  Eigen::Matrix<double, 3, 2> plane;
  plane.col(0) = n.cross(Vector3d::Unit(least)).normalized();
  plane.col(1) = n.cross(plane.col(0));
  return plane;
}

}  // namespace vispline

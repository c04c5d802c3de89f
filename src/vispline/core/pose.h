/// A rigid-body pose, the element of SE(3). `T_a_b` maps coordinates in frame b to coordinates in frame a.
#pragma once

#include <Eigen/Geometry>

#include "vispline/core/types.h"

namespace vispline {

template <class T>
struct PoseT {
  Matrix3<T> R = Matrix3<T>::Identity();
  Vector3<T> p = Vector3<T>::Zero();

  PoseT operator*(const PoseT& other) const { return {R * other.R, R * other.p + p}; }
  Vector3<T> operator*(const Vector3<T>& point) const { return R * point + p; }
  PoseT inverse() const { return {R.transpose(), -(R.transpose() * p)}; }
  Eigen::Quaternion<T> quaternion() const { return Eigen::Quaternion<T>(R); }

  template <class U>
  PoseT<U> cast() const {
    return {R.template cast<U>(), p.template cast<U>()};
  }
};

using Pose = PoseT<double>;

}  // namespace vispline

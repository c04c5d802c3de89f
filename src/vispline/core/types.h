/// Short names for the small fixed-size vectors and matrices of every formula.
#pragma once

#include <Eigen/Core>

namespace vispline {

template <class T>
using Vector2 = Eigen::Matrix<T, 2, 1>;
template <class T>
using Vector3 = Eigen::Matrix<T, 3, 1>;
template <class T>
using Vector6 = Eigen::Matrix<T, 6, 1>;
template <class T>
using Matrix3 = Eigen::Matrix<T, 3, 3>;
template <class T>
using Matrix6 = Eigen::Matrix<T, 6, 6>;

using Vector2d = Vector2<double>;
using Vector3d = Vector3<double>;
using Vector6d = Vector6<double>;
using Matrix3d = Matrix3<double>;
using Matrix6d = Matrix6<double>;

}  // namespace vispline

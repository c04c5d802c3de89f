/// R^n as a group under addition: the group of bias splines and of the translation of the split spline.
#pragma once

#include "vispline/core/types.h"

namespace vispline {

template <int N>
struct Rn {
  static constexpr int kDof = N;
  template <class T>
  using Element = Eigen::Matrix<T, N, 1>;
  template <class T>
  using Tangent = Eigen::Matrix<T, N, 1>;
  /// Ad and the Jacobians are the identity and ad is zero: multiples of the identity are all that is needed.
  template <class T>
  using Operator = T;

  template <class T>
  static Element<T> identity() {
    return Element<T>::Zero();
  }
  template <class T>
  static Operator<T> identity_operator() {
    return T(1);
  }
  template <class T>
  static Element<T> compose(const Element<T>& a, const Element<T>& b) {
    return a + b;
  }
  template <class T>
  static Element<T> inverse(const Element<T>& a) {
    return -a;
  }
  template <class T>
  static Element<T> exp(const Tangent<T>& x) {
    return x;
  }
  template <class T>
  static Tangent<T> log(const Element<T>& a) {
    return a;
  }
  template <class T>
  static Operator<T> Ad(const Element<T>&) {
    return T(1);
  }
  template <class T>
  static Operator<T> Ad_inverse(const Element<T>&) {
    return T(1);
  }
  template <class T>
  static Tangent<T> Ad_inverse(const Element<T>&, const Tangent<T>& x) {
    return x;
  }
  template <class T>
  static Operator<T> ad(const Tangent<T>&) {
    return T(0);
  }
  template <class T>
  static Operator<T> ad_times(const Tangent<T>&, const Operator<T>&) {
    return T(0);
  }
  template <class T>
  static Operator<T> times_ad(const Operator<T>&, const Tangent<T>&) {
    return T(0);
  }
  template <class Rows, class T>
  static auto times_ad(const Eigen::MatrixBase<Rows>& rows, const Eigen::Matrix<T, N, 1>&) {
    return Eigen::Matrix<T, Rows::RowsAtCompileTime, N>::Zero(rows.rows(), N);
  }
  template <class T>
  static Tangent<T> bracket(const Tangent<T>&, const Tangent<T>&) {
    return Tangent<T>::Zero();
  }
  template <class T>
  static Operator<T> left_jacobian(const Tangent<T>&) {
    return T(1);
  }
  template <class T>
  static Operator<T> left_jacobian_inverse(const Tangent<T>&) {
    return T(1);
  }
};

}  // namespace vispline

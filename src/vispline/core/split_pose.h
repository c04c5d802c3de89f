/// R^3 x SO(3), poses whose position and attitude are perturbed apart: p + delta_p in frame w, R exp(delta_theta).
/// The group of the split spline; the tangent is (translation, rotation), as on SE(3).
#pragma once

#include "vispline/core/pose.h"
#include "vispline/core/so3.h"

namespace vispline {

/// The 6x6 matrix [s I, 0; 0, R].
template <class T>
struct SplitMatrix {
  T s;
  Matrix3<T> R;

  SplitMatrix operator*(const SplitMatrix& o) const { return {s * o.s, R * o.R}; }
  SplitMatrix operator+(const SplitMatrix& o) const { return {s + o.s, R + o.R}; }
  SplitMatrix operator-(const SplitMatrix& o) const { return {s - o.s, R - o.R}; }
  SplitMatrix operator-() const { return {-s, -R}; }
  SplitMatrix& operator+=(const SplitMatrix& o) { return *this = *this + o; }
  friend SplitMatrix operator*(const T& k, const SplitMatrix& M) { return {k * M.s, k * M.R}; }
  Vector6<T> operator*(const Vector6<T>& x) const {
    Vector6<T> y;
    y << s * x.template head<3>(), R * x.template tail<3>();
    return y;
  }
  Matrix6<T> dense() const {
    Matrix6<T> M = Matrix6<T>::Zero();
    M.template topLeftCorner<3, 3>().diagonal().setConstant(s);
    M.template bottomRightCorner<3, 3>() = R;
    return M;
  }
  /// rows * [s I, 0; 0, R].
  template <class Rows>
  friend Eigen::Matrix<T, Rows::RowsAtCompileTime, 6> operator*(const Eigen::MatrixBase<Rows>& rows,
                                                                const SplitMatrix& M) {
    Eigen::Matrix<T, Rows::RowsAtCompileTime, 6> product;
    product.template leftCols<3>() = M.s * rows.template leftCols<3>();
    product.template rightCols<3>().noalias() = rows.template rightCols<3>() * M.R;
    return product;
  }
};

struct SplitPose {
  static constexpr int kDof = 6;
  template <class T>
  using Element = PoseT<T>;
  template <class T>
  using Tangent = Vector6<T>;
  template <class T>
  using Operator = SplitMatrix<T>;

  template <class T>
  static Element<T> identity() {
    return {};
  }
  template <class T>
  static Operator<T> identity_operator() {
    return {T(1), Matrix3<T>::Identity()};
  }
  template <class T>
  static Element<T> compose(const Element<T>& A, const Element<T>& B) {
    return {A.R * B.R, A.p + B.p};
  }
  template <class T>
  static Element<T> inverse(const Element<T>& X) {
    return {X.R.transpose(), -X.p};
  }
  template <class T>
  static Element<T> exp(const Tangent<T>& xi) {
    return {SO3::exp<T>(xi.template tail<3>()), xi.template head<3>()};
  }
  template <class T>
  static Tangent<T> log(const Element<T>& X) {
    Tangent<T> xi;
    xi << X.p, SO3::log<T>(X.R);
    return xi;
  }
  template <class T>
  static Operator<T> Ad(const Element<T>& X) {
    return {T(1), X.R};
  }
  template <class T>
  static Operator<T> Ad_inverse(const Element<T>& X) {
    return {T(1), X.R.transpose()};
  }
  /// Ad(X^-1) x, without the operator.
  template <class T>
  static Tangent<T> Ad_inverse(const Element<T>& X, const Tangent<T>& x) {
    Tangent<T> y;
    y << x.template head<3>(), X.R.transpose() * x.template tail<3>();
    return y;
  }
  template <class T>
  static Operator<T> ad(const Tangent<T>& xi) {
    return {T(0), hat<T>(xi.template tail<3>())};
  }
  template <class T>
  static Operator<T> ad_times(const Tangent<T>& xi, const Operator<T>& M) {
    return {T(0), hat_times<T>(xi.template tail<3>(), M.R)};
  }
  template <class T>
  static Operator<T> times_ad(const Operator<T>& M, const Tangent<T>& xi) {
    return {T(0), times_hat<Matrix3<T>, T>(M.R, xi.template tail<3>())};
  }
  template <class Rows, class T>
  static auto times_ad(const Eigen::MatrixBase<Rows>& rows, const Vector6<T>& xi) {
    const Vector3<T> w = xi.template tail<3>();
    Eigen::Matrix<T, Rows::RowsAtCompileTime, 6> product;
    product.template leftCols<3>().setZero();
    product.template rightCols<3>() = times_hat(rows.template rightCols<3>(), w);
    return product;
  }
  template <class T>
  static Tangent<T> bracket(const Tangent<T>& a, const Tangent<T>& b) {
    Tangent<T> c = Tangent<T>::Zero();
    c.template tail<3>() = a.template tail<3>().cross(b.template tail<3>());
    return c;
  }
  template <class T>
  static Operator<T> left_jacobian(const Tangent<T>& xi) {
    return {T(1), SO3::left_jacobian<T>(xi.template tail<3>())};
  }
  template <class T>
  static Operator<T> left_jacobian_inverse(const Tangent<T>& xi) {
    return {T(1), SO3::left_jacobian_inverse<T>(xi.template tail<3>())};
  }
};

}  // namespace vispline

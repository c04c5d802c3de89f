/// SE(3): poses, tangent = twist (v, omega) with translation first, right perturbation T exp(delta).
/// Ad, ad and all Jacobians of SE(3) are those of SO(3) over the dual numbers w + eps v (principle of transference):
/// one 3x3 matrix A on the diagonal twice, one 3x3 matrix B above it. docs/math/lie.md, equations (10)-(16).
#pragma once

#include "vispline/core/pose.h"
#include "vispline/core/so3.h"

namespace vispline {

/// The 6x6 matrix [A B; 0 A]. A product costs three 3x3 products instead of eight.
template <class T>
struct DualMatrix {
  Matrix3<T> A, B;

  /// Written out: compilers do better with it than with four Eigen expressions.
  DualMatrix operator*(const DualMatrix& o) const {
    DualMatrix product;
    for (int c = 0; c < 3; ++c) {
      for (int r = 0; r < 3; ++r) {
        product.A(r, c) = A(r, 0) * o.A(0, c) + A(r, 1) * o.A(1, c) + A(r, 2) * o.A(2, c);
        product.B(r, c) = A(r, 0) * o.B(0, c) + A(r, 1) * o.B(1, c) + A(r, 2) * o.B(2, c) + B(r, 0) * o.A(0, c) +
                          B(r, 1) * o.A(1, c) + B(r, 2) * o.A(2, c);
      }
    }
    return product;
  }
  DualMatrix operator+(const DualMatrix& o) const { return {A + o.A, B + o.B}; }
  DualMatrix operator-(const DualMatrix& o) const { return {A - o.A, B - o.B}; }
  DualMatrix operator-() const { return {-A, -B}; }
  DualMatrix& operator+=(const DualMatrix& o) { return *this = *this + o; }
  friend DualMatrix operator*(const T& s, const DualMatrix& M) { return {s * M.A, s * M.B}; }
  Vector6<T> operator*(const Vector6<T>& x) const {
    Vector6<T> y;
    y.template head<3>() = A * x.template head<3>() + B * x.template tail<3>();
    y.template tail<3>() = A * x.template tail<3>();
    return y;
  }
  Matrix6<T> dense() const {
    Matrix6<T> M;
    M << A, B, Matrix3<T>::Zero(), A;
    return M;
  }
  /// rows * [A B; 0 A].
  template <class Rows>
  friend Eigen::Matrix<T, Rows::RowsAtCompileTime, 6> operator*(const Eigen::MatrixBase<Rows>& rows,
                                                                const DualMatrix& M) {
    Eigen::Matrix<T, Rows::RowsAtCompileTime, 6> product;
    for (int c = 0; c < 3; ++c) {
      product.col(c) = rows.col(0) * M.A(0, c) + rows.col(1) * M.A(1, c) + rows.col(2) * M.A(2, c);
      product.col(3 + c) = rows.col(0) * M.B(0, c) + rows.col(1) * M.B(1, c) + rows.col(2) * M.B(2, c) +
                           rows.col(3) * M.A(0, c) + rows.col(4) * M.A(1, c) + rows.col(5) * M.A(2, c);
    }
    return product;
  }
};

struct SE3 {
  static constexpr int kDof = 6;
  template <class T>
  using Element = PoseT<T>;
  template <class T>
  using Tangent = Vector6<T>;
  template <class T>
  using Operator = DualMatrix<T>;

  template <class T>
  static Element<T> identity() {
    return {};
  }
  template <class T>
  static Operator<T> identity_operator() {
    return {Matrix3<T>::Identity(), Matrix3<T>::Zero()};
  }
  template <class T>
  static Element<T> compose(const Element<T>& A, const Element<T>& B) {
    return A * B;
  }
  template <class T>
  static Element<T> inverse(const Element<T>& X) {
    return X.inverse();
  }
  template <class T>
  static Element<T> exp(const Tangent<T>& xi) {
    const Vector3<T> v = xi.template head<3>(), w = xi.template tail<3>();
    const RotationSeries<T> s(w.squaredNorm());
    return {SO3::exp(w, s), v + s.b * w.cross(v) + s.c * w.cross(w.cross(v))};
  }
  template <class T>
  static Tangent<T> log(const Element<T>& X) {
    Tangent<T> xi;
    const Vector3<T> w = SO3::log<T>(X.R);
    xi << SO3::left_jacobian_inverse<T>(w) * X.p, w;
    return xi;
  }
  template <class T>
  static Operator<T> Ad(const Element<T>& X) {
    return {X.R, hat(X.p) * X.R};
  }
  /// Ad(X^-1).
  template <class T>
  static Operator<T> Ad_inverse(const Element<T>& X) {
    const Matrix3<T> R_t = X.R.transpose();
    return {R_t, -times_hat(R_t, X.p)};
  }
  /// Ad(X^-1) x, without the operator.
  template <class T>
  static Tangent<T> Ad_inverse(const Element<T>& X, const Tangent<T>& x) {
    const Vector3<T> v = x.template head<3>(), w = x.template tail<3>();
    Tangent<T> y;
    y << X.R.transpose() * (v - X.p.cross(w)), X.R.transpose() * w;
    return y;
  }
  template <class T>
  static Operator<T> ad(const Tangent<T>& xi) {
    return {hat<T>(xi.template tail<3>()), hat<T>(xi.template head<3>())};
  }
  template <class T>
  static Operator<T> ad_times(const Tangent<T>& xi, const Operator<T>& M) {
    const Vector3<T> v = xi.template head<3>(), w = xi.template tail<3>();
    return {hat_times(w, M.A), hat_times(w, M.B) + hat_times(v, M.A)};
  }
  template <class T>
  static Operator<T> times_ad(const Operator<T>& M, const Tangent<T>& xi) {
    const Vector3<T> v = xi.template head<3>(), w = xi.template tail<3>();
    return {times_hat(M.A, w), times_hat(M.B, w) + times_hat(M.A, v)};
  }
  template <class Rows, class T>
  static auto times_ad(const Eigen::MatrixBase<Rows>& rows, const Vector6<T>& xi) {
    const Vector3<T> v = xi.template head<3>(), w = xi.template tail<3>();
    Eigen::Matrix<T, Rows::RowsAtCompileTime, 6> product;
    product.template leftCols<3>() = times_hat(rows.template leftCols<3>(), w);
    product.template rightCols<3>() =
        times_hat(rows.template leftCols<3>(), v) + times_hat(rows.template rightCols<3>(), w);
    return product;
  }
  template <class T>
  static Tangent<T> bracket(const Tangent<T>& a, const Tangent<T>& b) {
    const Vector3<T> va = a.template head<3>(), wa = a.template tail<3>();
    const Vector3<T> vb = b.template head<3>(), wb = b.template tail<3>();
    Tangent<T> c;
    c << wa.cross(vb) + va.cross(wb), wa.cross(wb);
    return c;
  }
  template <class T>
  static Operator<T> left_jacobian(const Tangent<T>& xi) {
    const RotationSeries<T> s(xi.template tail<3>().squaredNorm());
    return transfer<T>(xi, s.b, s.c, s.db, s.dc);
  }
  template <class T>
  static Operator<T> left_jacobian_inverse(const Tangent<T>& xi) {
    const RotationSeries<T> s(xi.template tail<3>().squaredNorm());
    const T g = -s.db / s.b;
    const T dg = -s.ddb / s.b + g * g;  // (b'^2 - b b'') / b^2
    return transfer<T>(xi, T(-0.5), g, T(0), dg);
  }

 private:
  /// I + f W + g W^2 over the dual numbers; f, g and their derivatives are at x = |w|^2, whose dual part is 2 w.v.
  template <class T>
  static Operator<T> transfer(const Tangent<T>& xi, const T& f, const T& g, const T& df, const T& dg) {
    const Vector3<T> v = xi.template head<3>(), w = xi.template tail<3>();
    const T wv = w.dot(v);
    const Vector3<T> s = f * v + (T(2) * wv * df) * w;  // of the skew part of the dual part
    const T h = T(2) * wv * dg;
    Matrix3<T> B;
    for (int c = 0; c < 3; ++c) {
      for (int r = 0; r <= c; ++r) B(r, c) = B(c, r) = g * (v(r) * w(c) + w(r) * v(c)) + h * (w(r) * w(c));
      B(c, c) -= T(2) * wv * g + h * w.squaredNorm();
    }
    return {SO3::one_plus(f, g, w), B + hat(s)};
  }
};

}  // namespace vispline

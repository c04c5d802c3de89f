/// SO(3): rotation matrices, tangent = rotation vector (rad), right perturbation R exp(delta) by the full angle.
/// docs/math/lie.md, equations (1)-(9). Stable from 0 to pi; all functions are templates over the scalar.
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "vispline/core/types.h"

namespace vispline {

/// Skew-symmetric matrix: hat(a) b = a x b.
template <class T>
Matrix3<T> hat(const Vector3<T>& a) {
  Matrix3<T> A;
  A << T(0), -a.z(), a.y(), a.z(), T(0), -a.x(), -a.y(), a.x(), T(0);
  return A;
}

/// Inverse of hat, of the skew part of A.
template <class T>
Vector3<T> vee(const Matrix3<T>& A) {
  return T(0.5) * Vector3<T>(A(2, 1) - A(1, 2), A(0, 2) - A(2, 0), A(1, 0) - A(0, 1));
}

/// hat(w) M, without the matrix.
template <class T>
Matrix3<T> hat_times(const Vector3<T>& w, const Matrix3<T>& M) {
  Matrix3<T> product;
  for (int c = 0; c < 3; ++c) {
    product(0, c) = w.y() * M(2, c) - w.z() * M(1, c);
    product(1, c) = w.z() * M(0, c) - w.x() * M(2, c);
    product(2, c) = w.x() * M(1, c) - w.y() * M(0, c);
  }
  return product;
}

/// rows hat(w), without the matrix.
template <class Rows, class T>
Eigen::Matrix<T, Rows::RowsAtCompileTime, 3> times_hat(const Eigen::MatrixBase<Rows>& rows, const Vector3<T>& w) {
  Eigen::Matrix<T, Rows::RowsAtCompileTime, 3> product;
  product.col(0) = w.z() * rows.col(1) - w.y() * rows.col(2);
  product.col(1) = w.x() * rows.col(2) - w.z() * rows.col(0);
  product.col(2) = w.y() * rows.col(0) - w.x() * rows.col(1);
  return product;
}

namespace detail {

inline constexpr int kSeriesTerms = 10;

/// Coefficients of sum_n (-1)^n x^n / (2n + offset)!, differentiated `derivative` times with respect to x.
constexpr std::array<double, kSeriesTerms> factorial_series(int offset, int derivative) {
  std::array<double, kSeriesTerms> coefficients{};
  for (int i = 0; i < kSeriesTerms; ++i) {
    const int n = i + derivative;
    double value = n % 2 == 0 ? 1.0 : -1.0;
    for (int k = 2; k <= 2 * n + offset; ++k) value /= k;
    for (int k = 0; k < derivative; ++k) value *= n - k;
    coefficients[static_cast<std::size_t>(i)] = value;
  }
  return coefficients;
}

/// Even and odd terms apart: two chains of half the length.
template <class T>
[[gnu::always_inline]] inline T horner(const std::array<double, kSeriesTerms>& coefficients, const T& x, const T& xx) {
  static_assert(kSeriesTerms % 2 == 0);
  T even = T(coefficients[kSeriesTerms - 2]), odd = T(coefficients[kSeriesTerms - 1]);
  for (std::size_t i = kSeriesTerms - 2; i > 0; i -= 2) {
    even = even * xx + T(coefficients[i - 2]);
    odd = odd * xx + T(coefficients[i - 1]);
  }
  return even + x * odd;
}

}  // namespace detail

/// The scalar functions of x = theta^2 behind exp and the Jacobians, and their derivatives with respect to x:
///   b = (1 - cos theta) / theta^2,   c = (theta - sin theta) / theta^3.            docs/math/lie.md (2)
/// A power series below 1 rad, closed forms above: both are good to the last digits at the border.
template <class T>
struct RotationSeries {
  T b, c;         ///< exp = I + (1 - x c) W + b W^2,  J_l = I + b W + c W^2
  T db, dc, ddb;  ///< db/dx, dc/dx, d^2 b/dx^2

  /// Inlined, so that a caller pays only for the numbers it takes.
  [[gnu::always_inline]] explicit RotationSeries(const T& x) {
    using std::cos, std::sin, std::sqrt;
    if (x < T(1)) {
      const T xx = x * x;
      b = detail::horner(kB, x, xx);
      c = detail::horner(kC, x, xx);
      db = detail::horner(kDb, x, xx);
      dc = detail::horner(kDc, x, xx);
      ddb = detail::horner(kDdb, x, xx);
    } else {
      const T theta = sqrt(x);
      const T a = sin(theta) / theta;
      b = (T(1) - cos(theta)) / x;
      c = (T(1) - a) / x;
      db = (a - T(2) * b) / (T(2) * x);
      dc = (b - T(3) * c) / (T(2) * x);
      ddb = (T(0.5) * (c - b) - T(4) * db) / (T(2) * x);
    }
  }

 private:
  static constexpr auto kB = detail::factorial_series(2, 0);
  static constexpr auto kC = detail::factorial_series(3, 0);
  static constexpr auto kDb = detail::factorial_series(2, 1);
  static constexpr auto kDc = detail::factorial_series(3, 1);
  static constexpr auto kDdb = detail::factorial_series(2, 2);
};

/// w w^T - (w.w) I = W^2, without the matrix product.
template <class T>
Matrix3<T> hat_squared(const Vector3<T>& w) {
  const T xx = w.x() * w.x(), yy = w.y() * w.y(), zz = w.z() * w.z();
  const T xy = w.x() * w.y(), xz = w.x() * w.z(), yz = w.y() * w.z();
  Matrix3<T> W2;
  W2 << -(yy + zz), xy, xz, xy, -(xx + zz), yz, xz, yz, -(xx + yy);
  return W2;
}

/// The group, as the cumulative spline asks for it.
struct SO3 {
  static constexpr int kDof = 3;
  template <class T>
  using Element = Matrix3<T>;
  template <class T>
  using Tangent = Vector3<T>;
  /// Linear maps of the tangent space that Ad, ad and the Jacobians span.
  template <class T>
  using Operator = Matrix3<T>;

  template <class T>
  static Element<T> identity() {
    return Matrix3<T>::Identity();
  }
  template <class T>
  static Operator<T> identity_operator() {
    return Matrix3<T>::Identity();
  }
  template <class T>
  static Element<T> compose(const Element<T>& A, const Element<T>& B) {
    return A * B;
  }
  template <class T>
  static Element<T> inverse(const Element<T>& R) {
    return R.transpose();
  }
  template <class T>
  static Element<T> exp(const Tangent<T>& w) {
    return exp(w, RotationSeries<T>(w.squaredNorm()));
  }
  template <class T>
  static Element<T> exp(const Tangent<T>& w, const RotationSeries<T>& s) {
    return one_plus(T(1) - w.squaredNorm() * s.c, s.b, w);
  }
  /// Rotation vector with |w| <= pi. Through the quaternion, which is well conditioned up to pi.
  template <class T>
  static Tangent<T> log(const Element<T>& R) {
    using std::atan2, std::sqrt;
    Eigen::Quaternion<T> q(R);
    if (q.w() < T(0)) q.coeffs() = -q.coeffs();
    const T n2 = q.vec().squaredNorm();
    if (n2 < T(1e-10)) {  // 2 asin(n)/n about n = 0; the next term is 2e-21
      return T(2) * (T(1) + n2 * (T(1.0 / 6.0) + n2 * T(3.0 / 40.0))) * q.vec();
    }
    const T n = sqrt(n2);
    return (T(2) * atan2(n, q.w()) / n) * q.vec();
  }
  template <class T>
  static Operator<T> Ad(const Element<T>& R) {
    return R;
  }
  template <class T>
  static Operator<T> Ad_inverse(const Element<T>& R) {
    return R.transpose();
  }
  /// Ad(R^-1) x, without the operator.
  template <class T>
  static Tangent<T> Ad_inverse(const Element<T>& R, const Tangent<T>& x) {
    return R.transpose() * x;
  }
  template <class T>
  static Operator<T> ad(const Tangent<T>& w) {
    return hat(w);
  }
  /// ad(w) M and M ad(w) (M an operator, or rows), without the operator ad(w).
  template <class T>
  static Operator<T> ad_times(const Tangent<T>& w, const Operator<T>& M) {
    return hat_times(w, M);
  }
  template <class Rows, class T>
  static auto times_ad(const Eigen::MatrixBase<Rows>& rows, const Vector3<T>& w) {
    return times_hat(rows, w);
  }
  /// ad(a) b, the Lie bracket.
  template <class T>
  static Tangent<T> bracket(const Tangent<T>& a, const Tangent<T>& b) {
    return a.cross(b);
  }
  template <class T>
  static Operator<T> left_jacobian(const Tangent<T>& w) {
    return left_jacobian(w, RotationSeries<T>(w.squaredNorm()));
  }
  template <class T>
  static Operator<T> left_jacobian(const Tangent<T>& w, const RotationSeries<T>& s) {
    return one_plus(s.b, s.c, w);
  }
  /// Singular at 2 pi, regular at pi: I - W/2 + g W^2 with g = -b'/b.
  template <class T>
  static Operator<T> left_jacobian_inverse(const Tangent<T>& w) {
    const RotationSeries<T> s(w.squaredNorm());
    return one_plus(T(-0.5), T(-s.db / s.b), w);
  }
  /// I + f W + g W^2, written out.
  template <class T>
  static Matrix3<T> one_plus(const T& f, const T& g, const Vector3<T>& w) {
    const T gx = g * w.x(), gy = g * w.y(), gz = g * w.z();
    const T xx = gx * w.x(), yy = gy * w.y(), zz = gz * w.z(), xy = gx * w.y(), xz = gx * w.z(), yz = gy * w.z();
    const T x = f * w.x(), y = f * w.y(), z = f * w.z();
    Matrix3<T> M;
    M << T(1) - (yy + zz), xy - z, xz + y, xy + z, T(1) - (xx + zz), yz - x, xz - y, yz + x, T(1) - (xx + yy);
    return M;
  }
};

}  // namespace vispline

/// The radial-tangential distortion of Brown with two and two terms, as Kalibr and OpenCV have it. docs/math/camera.md
/// (11)
///   d = m (1 + k1 q + k2 q^2) + (2 p1 x y + p2 (q + 2 x^2), p1 (q + 2 y^2) + 2 p2 x y),   m = (x, y), q = |m|^2
/// Domain: the largest disc on which the Jacobian, which is symmetric, is surely positive definite: of radius below the
/// first root of 1 - 6 |p| r + 3 k1 r^2 + 5 k2 r^4 and of 1 - 6 |p| r + k1 r^2 + k2 r^4. On a convex set that makes the
/// map one to one.
#pragma once

#include <cmath>

#include "vispline/sensors/lenses/newton.h"
#include "vispline/sensors/lenses/positive.h"
#include "vispline/sensors/lenses/stage.h"

namespace vispline::lenses {

struct Radtan {
  static constexpr std::array<std::string_view, 4> kParams{"k1", "k2", "p1", "p2"};

  template <class T>
  static std::optional<Vector2<T>> distort(const T* k, const Vector2<T>& m) {
    const T q = m.squaredNorm();
    if (!in_domain(k, q)) return std::nullopt;
    const T x = m.x(), y = m.y(), gain = T(1) + q * (k[0] + q * k[1]);
    return Vector2<T>(gain * x + T(2) * k[2] * x * y + k[3] * (q + T(2) * x * x),
                      gain * y + T(2) * k[3] * x * y + k[2] * (q + T(2) * y * y));
  }

  static std::optional<PlanePoint<2, 4>> linearize(const double* k, const Vector2d& m) {
    const double q = m.squaredNorm();
    if (!in_domain(k, q)) return std::nullopt;
    const double x = m.x(), y = m.y(), p1 = k[2], p2 = k[3];
    const double gain = 1.0 + q * (k[0] + q * k[1]), slope = 2.0 * k[0] + 4.0 * q * k[1];
    const double mixed = 2.0 * x * y, along_x = q + 2.0 * x * x, along_y = q + 2.0 * y * y;
    PlanePoint<2, 4> result;
    result.m << gain * x + p1 * mixed + p2 * along_x, gain * y + p2 * mixed + p1 * along_y;
    const double off_diagonal = slope * x * y + 2.0 * (p1 * x + p2 * y);
    result.d_input << gain + slope * x * x + 2.0 * p1 * y + 6.0 * p2 * x, off_diagonal,  //
        off_diagonal, gain + slope * y * y + 6.0 * p1 * y + 2.0 * p2 * x;
    result.d_params << q * x, q * q * x, mixed, along_x,  //
        q * y, q * q * y, along_y, mixed;
    return result;
  }

  static std::optional<Vector2d> undistort(const double* k, const Vector2d& d) {
    return undistort_by_newton<Radtan>(k, d);
  }

 private:
  template <class T>
  static bool in_domain(const T* k, const T& q) {
    using std::sqrt;
    const T p2 = k[2] * k[2] + k[3] * k[3];
    const T p = p2 > T(0) ? T(sqrt(p2)) : T(0), r = q > T(0) ? T(sqrt(q)) : q;
    return positive_on<T>({T(1), T(-6) * p, T(3) * k[0], T(0), T(5) * k[1]}, r) &&
           positive_on<T>({T(1), T(-6) * p, k[0], T(0), k[1]}, r);
  }
};

static_assert(Distortion<Radtan>);

}  // namespace vispline::lenses

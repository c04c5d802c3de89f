/// The extended unified model of Khomutenko, Garcia and Martinet (RA-L 2016), Kalibr's "eucm". docs/math/camera.md (7)
///   d = sqrt(beta (x^2 + y^2) + z^2),   m = (x, y) / (alpha d + (1 - alpha) z)
/// Domain: the denominator and (1 - alpha) d + alpha z are positive.
#pragma once

#include <cmath>

#include "vispline/sensors/lenses/quotient.h"

namespace vispline::lenses {

struct ExtendedUnified {
  static constexpr std::array<std::string_view, 2> kParams{"alpha", "beta"};

  template <class T>
  static std::optional<Vector2<T>> project(const T* params, const Vector3<T>& point_c) {
    const Terms<T> t(params, point_c);
    if (!t.valid) return std::nullopt;
    return Vector2<T>(point_c.x() / t.denominator, point_c.y() / t.denominator);
  }

  static std::optional<PlanePoint<3, 2>> linearize(const double* params, const Vector3d& point_c) {
    const double alpha = params[0], beta = params[1];
    const Terms<double> t(params, point_c);
    if (!t.valid) return std::nullopt;
    const double slope = alpha / t.d;
    const Vector3d gradient(slope * beta * point_c.x(), slope * beta * point_c.y(),
                            slope * point_c.z() + (1.0 - alpha));
    return quotient<2>(point_c, t.denominator, gradient, {t.d - point_c.z(), 0.5 * slope * t.rho2});
  }

  static std::optional<Vector3d> unproject(const double* params, const Vector2d& m) {
    const double alpha = params[0], beta = params[1];
    const double r2 = beta * m.squaredNorm();
    const double outer = 1.0 - (2.0 * alpha - 1.0) * r2;
    if (!(outer > 0.0)) return std::nullopt;
    const Vector3d direction_c(m.x(), m.y(), (1.0 - alpha * alpha * r2) / (alpha * std::sqrt(outer) + 1.0 - alpha));
    if (!Terms<double>(params, direction_c).valid) return std::nullopt;
    return direction_c;
  }

 private:
  template <class T>
  struct Terms {
    T rho2, d, denominator;
    bool valid;

    Terms(const T* params, const Vector3<T>& point_c) {
      using std::sqrt;
      const T &alpha = params[0], &beta = params[1];
      rho2 = point_c.x() * point_c.x() + point_c.y() * point_c.y();
      d = sqrt(beta * rho2 + point_c.z() * point_c.z());
      denominator = alpha * d + (T(1) - alpha) * point_c.z();
      valid = denominator > T(0) && (T(1) - alpha) * d + alpha * point_c.z() > T(0);
    }
  };
};

static_assert(Projection<ExtendedUnified>);

}  // namespace vispline::lenses

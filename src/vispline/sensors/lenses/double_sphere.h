/// The double sphere model of Usenko, Demmel and Cremers (3DV 2018), Kalibr's "ds". docs/math/camera.md (6)
///   z1 = z + xi |point|,   d2 = |(x, y, z1)|,   m = (x, y) / (alpha d2 + (1 - alpha) z1)
/// Domain: the denominator, (1 - alpha) d2 + alpha z1 and |point| + xi z are positive.
#pragma once

#include <cmath>

#include "vispline/sensors/lenses/quotient.h"

namespace vispline::lenses {

struct DoubleSphere {
  static constexpr std::array<std::string_view, 2> kParams{"xi", "alpha"};

  template <class T>
  static std::optional<Vector2<T>> project(const T* params, const Vector3<T>& point_c) {
    const Terms<T> t(params, point_c);
    if (!t.valid) return std::nullopt;
    return Vector2<T>(point_c.x() / t.denominator, point_c.y() / t.denominator);
  }

  static std::optional<PlanePoint<3, 2>> linearize(const double* params, const Vector3d& point_c) {
    const double xi = params[0], alpha = params[1];
    const Terms<double> t(params, point_c);
    if (!t.valid) return std::nullopt;
    const double d_z1 = alpha * t.z1 / t.d2 + (1.0 - alpha);  // of the denominator
    Vector3d gradient = (d_z1 * xi / t.d1) * point_c;
    gradient.z() += d_z1;
    gradient.head<2>() += (alpha / t.d2) * point_c.head<2>();
    return quotient<2>(point_c, t.denominator, gradient, {d_z1 * t.d1, t.d2 - t.z1});
  }

  static std::optional<Vector3d> unproject(const double* params, const Vector2d& m) {
    const double xi = params[0], alpha = params[1];
    const double r2 = m.squaredNorm();
    const double outer = 1.0 - (2.0 * alpha - 1.0) * r2;
    if (!(outer > 0.0)) return std::nullopt;
    const double mz = (1.0 - alpha * alpha * r2) / (alpha * std::sqrt(outer) + 1.0 - alpha);
    const double inner = mz * mz + (1.0 - xi * xi) * r2;
    if (!(inner > 0.0)) return std::nullopt;
    const double scale = (mz * xi + std::sqrt(inner)) / (mz * mz + r2);
    const Vector3d direction_c(scale * m.x(), scale * m.y(), scale * mz - xi);
    if (!Terms<double>(params, direction_c).valid) return std::nullopt;
    return direction_c;
  }

 private:
  template <class T>
  struct Terms {
    T d1, z1, d2, denominator;
    bool valid;

    Terms(const T* params, const Vector3<T>& point_c) {
      using std::sqrt;
      const T &xi = params[0], &alpha = params[1];
      const T rho2 = point_c.x() * point_c.x() + point_c.y() * point_c.y();
      d1 = sqrt(rho2 + point_c.z() * point_c.z());
      z1 = point_c.z() + xi * d1;
      d2 = sqrt(rho2 + z1 * z1);
      denominator = alpha * d2 + (T(1) - alpha) * z1;
      valid = denominator > T(0) && (T(1) - alpha) * d2 + alpha * z1 > T(0) && d1 + xi * point_c.z() > T(0);
    }
  };
};

static_assert(Projection<DoubleSphere>);

}  // namespace vispline::lenses

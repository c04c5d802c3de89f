/// The unified model of Mei and Rives (ICRA 2007), Kalibr's "omni": a point is projected to the unit sphere, then from
/// xi above its centre to the plane. docs/math/camera.md (5)
///   m = (x, y) / (z + xi |point|)
/// Domain: z + xi |point| > 0 and |point| + xi z > 0; beyond the second, directions come down to pixels already taken.
#pragma once

#include <cmath>

#include "vispline/sensors/lenses/quotient.h"

namespace vispline::lenses {

struct Unified {
  static constexpr std::array<std::string_view, 1> kParams{"xi"};

  template <class T>
  static std::optional<Vector2<T>> project(const T* params, const Vector3<T>& point_c) {
    const T& xi = params[0];
    const T distance = point_c.norm();
    const T denominator = point_c.z() + xi * distance;
    if (!(denominator > T(0) && distance + xi * point_c.z() > T(0))) return std::nullopt;
    return Vector2<T>(point_c.x() / denominator, point_c.y() / denominator);
  }

  static std::optional<PlanePoint<3, 1>> linearize(const double* params, const Vector3d& point_c) {
    const double xi = params[0];
    const double distance = point_c.norm();
    const double denominator = point_c.z() + xi * distance;
    if (!(denominator > 0.0 && distance + xi * point_c.z() > 0.0)) return std::nullopt;
    Vector3d gradient = (xi / distance) * point_c;
    gradient.z() += 1.0;
    return quotient<1>(point_c, denominator, gradient, Eigen::Matrix<double, 1, 1>(distance));
  }

  static std::optional<Vector3d> unproject(const double* params, const Vector2d& m) {
    const double xi = params[0];
    const double r2 = m.squaredNorm();
    const double discriminant = 1.0 + (1.0 - xi * xi) * r2;
    if (!(xi > -1.0 && discriminant > 0.0)) return std::nullopt;
    const double scale = (xi + std::sqrt(discriminant)) / (1.0 + r2);
    return Vector3d(scale * m.x(), scale * m.y(), scale - xi);
  }
};

static_assert(Projection<Unified>);

}  // namespace vispline::lenses

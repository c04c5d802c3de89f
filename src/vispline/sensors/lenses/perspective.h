/// The pinhole: m = (x, y) / z for z > 0. docs/math/camera.md (4)
#pragma once

#include "vispline/sensors/lenses/quotient.h"

namespace vispline::lenses {

struct Perspective {
  static constexpr std::array<std::string_view, 0> kParams{};

  template <class T>
  static std::optional<Vector2<T>> project(const T*, const Vector3<T>& point_c) {
    if (!(point_c.z() > T(0))) return std::nullopt;
    return Vector2<T>(point_c.x() / point_c.z(), point_c.y() / point_c.z());
  }
  static std::optional<PlanePoint<3, 0>> linearize(const double*, const Vector3d& point_c) {
    if (!(point_c.z() > 0.0)) return std::nullopt;
    return quotient<0>(point_c, point_c.z(), Vector3d::UnitZ(), {});
  }
  static std::optional<Vector3d> unproject(const double*, const Vector2d& m) { return Vector3d(m.x(), m.y(), 1.0); }
};

static_assert(Projection<Perspective>);

}  // namespace vispline::lenses

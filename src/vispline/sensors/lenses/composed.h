/// A lens out of its two stages. docs/math/camera.md (1), (2).
#pragma once

#include <cmath>

#include "vispline/sensors/lens.h"
#include "vispline/sensors/lenses/stage.h"

namespace vispline::lenses {

template <Projection P, Distortion D>
struct Composed {
  static constexpr int kFocal = kStageParams<P>;  ///< index of fu
  static constexpr int kDistortion = kFocal + 4;
  static constexpr int kNumParams = kDistortion + kStageParams<D>;
  static_assert(kNumParams <= kMaxLensParams);

  static constexpr std::string_view param_name(int index) {
    constexpr std::array<std::string_view, 4> kPinholeParams{"fu", "fv", "pu", "pv"};
    if (index < kFocal) return P::kParams[static_cast<std::size_t>(index)];
    if (index < kDistortion) return kPinholeParams[static_cast<std::size_t>(index - kFocal)];
    return D::kParams[static_cast<std::size_t>(index - kDistortion)];
  }

  /// Pixel of the direction of point_c; empty outside the domain of the two stages.
  template <class T>
  static std::optional<Vector2<T>> project(const T* params, const Vector3<T>& point_c) {
    using std::isfinite;
    const std::optional<Vector2<T>> m = P::template project<T>(params, point_c);
    if (!m) return std::nullopt;
    const std::optional<Vector2<T>> d = D::template distort<T>(params + kDistortion, *m);
    if (!d) return std::nullopt;
    const T* f = params + kFocal;
    const Vector2<T> px(f[0] * d->x() + f[2], f[1] * d->y() + f[3]);
    if (!isfinite(px.x()) || !isfinite(px.y())) return std::nullopt;
    return px;
  }

  /// One variable is returned throughout, so that it is made in the caller's place.
  static std::optional<LensProjection> linearize(const double* params, const Vector3d& point_c) {
    std::optional<LensProjection> result;
    const auto m = P::linearize(params, point_c);
    if (!m) return result;
    const auto d = D::linearize(params + kDistortion, m->m);
    if (!d) return result;
    const double* f = params + kFocal;
    const Vector2d focal(f[0], f[1]);
    const Vector2d px = focal.cwiseProduct(d->m) + Vector2d(f[2], f[3]);
    if (!px.allFinite()) return result;
    result.emplace();
    result->px = px;
    const Matrix2d d_plane = focal.asDiagonal() * d->d_input;
    result->d_point.noalias() = d_plane.lazyProduct(m->d_input);
    result->d_params.resize(2, kNumParams);
    Eigen::Map<Eigen::Matrix<double, 2, kNumParams>> d_params(result->d_params.data());
    if constexpr (kFocal > 0) d_params.template leftCols<kFocal>() = d_plane.lazyProduct(m->d_params);
    d_params.template middleCols<4>(kFocal) << d->m.x(), 0.0, 1.0, 0.0, 0.0, d->m.y(), 0.0, 1.0;
    if constexpr (kStageParams<D> > 0) {
      d_params.template rightCols<kStageParams<D>>() = focal.asDiagonal() * d->d_params;
    }
    return result;
  }

  static std::optional<Vector3d> unproject(const double* params, const Vector2d& px) {
    const double* f = params + kFocal;
    const Vector2d d((px.x() - f[2]) / f[0], (px.y() - f[3]) / f[1]);
    if (!d.allFinite()) return std::nullopt;
    const std::optional<Vector2d> m = D::undistort(params + kDistortion, d);
    if (!m) return std::nullopt;
    const std::optional<Vector3d> direction_c = P::unproject(params, *m);
    if (!direction_c) return std::nullopt;
    return direction_c->normalized();
  }
};

}  // namespace vispline::lenses

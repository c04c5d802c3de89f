/// The two stages of a lens: a projection of directions to a plane, then a distortion of that plane. A pixel is
///   px = (fu d_x + pu, fv d_y + pv),   d = distort(m),   m = project(point_c)       docs/math/camera.md (1)
/// Parameters stand in the order of Kalibr's files: those of the projection, fu fv pu pv, those of the distortion.
#pragma once

#include <array>
#include <concepts>
#include <optional>
#include <string_view>

#include "vispline/core/types.h"

namespace vispline::lenses {

using Matrix2d = Eigen::Matrix<double, 2, 2>;
using Matrix23d = Eigen::Matrix<double, 2, 3>;

/// A point of the plane and how it moves with what it was made from.
template <int kInputs, int kParams>
struct PlanePoint {
  Vector2d m;
  Eigen::Matrix<double, 2, kInputs> d_input;   ///< per unit of the point_c or of the undistorted m
  Eigen::Matrix<double, 2, kParams> d_params;  ///< per unit of the stage's own parameters
};

/// Number of parameters of a stage.
template <class Stage>
inline constexpr int kStageParams = static_cast<int>(Stage::kParams.size());

/// `kParams`: names; `project<T>`: direction to plane, empty outside the domain; `linearize`: the same with
/// derivatives; `unproject`: plane to a direction of any length, the inverse of project on its domain and empty
/// elsewhere.
template <class P>
concept Projection = requires(const double* params, const Vector3d& point_c, const Vector2d& m) {
  { P::kParams[0] } -> std::convertible_to<std::string_view>;
  { P::template project<double>(params, point_c) } -> std::same_as<std::optional<Vector2d>>;
  { P::linearize(params, point_c) } -> std::same_as<std::optional<PlanePoint<3, kStageParams<P>>>>;
  { P::unproject(params, m) } -> std::same_as<std::optional<Vector3d>>;
};

/// The same for a distortion: `distort<T>`, `linearize`, `undistort`.
template <class D>
concept Distortion = requires(const double* params, const Vector2d& m) {
  { D::kParams[0] } -> std::convertible_to<std::string_view>;
  { D::template distort<double>(params, m) } -> std::same_as<std::optional<Vector2d>>;
  { D::linearize(params, m) } -> std::same_as<std::optional<PlanePoint<2, kStageParams<D>>>>;
  { D::undistort(params, m) } -> std::same_as<std::optional<Vector2d>>;
};

/// Of a lens that is exact but for its projection.
struct NoDistortion {
  static constexpr std::array<std::string_view, 0> kParams{};
  template <class T>
  static std::optional<Vector2<T>> distort(const T*, const Vector2<T>& m) {
    return m;
  }
  static std::optional<PlanePoint<2, 0>> linearize(const double*, const Vector2d& m) {
    return PlanePoint<2, 0>{m, Matrix2d::Identity(), {}};
  }
  static std::optional<Vector2d> undistort(const double*, const Vector2d& d) { return d; }
};

}  // namespace vispline::lenses

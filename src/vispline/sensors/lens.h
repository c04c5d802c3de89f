/// A lens: which pixel sees a direction, and which direction a pixel sees. docs/math/camera.md, Lenses.
#pragma once

#include <optional>
#include <string_view>

#include "vispline/core/types.h"

namespace vispline {

/// Camera model and distortion of Kalibr in one. The order of the parameters is that of Kalibr's files: intrinsics,
/// then distortion.
enum class LensModel {
  kPinhole,             ///< fu fv pu pv
  kPinholeRadtan,       ///< fu fv pu pv k1 k2 p1 p2
  kPinholeEquidistant,  ///< fu fv pu pv k1 k2 k3 k4: Kannala-Brandt with four terms
  kPinholeFov,          ///< fu fv pu pv w
  kOmni,                ///< xi fu fv pu pv: Mei without distortion
  kOmniRadtan,          ///< xi fu fv pu pv k1 k2 p1 p2: Mei
  kDoubleSphere,        ///< xi alpha fu fv pu pv
  kExtendedUnified,     ///< alpha beta fu fv pu pv
};

inline constexpr int kMaxLensParams = 9;
using LensParams = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxLensParams, 1>;

/// A pixel and how it moves with the point and with the parameters of the lens.
struct LensProjection {
  Vector2d px;
  Eigen::Matrix<double, 2, 3> d_point;  ///< px per unit of the point
  Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::ColMajor, 2, kMaxLensParams> d_params;
};

/// A direction and how it moves with the parameters of the lens, the pixel held.
struct LensRay {
  Vector3d bearing_c;  ///< unit vector in frame c
  Eigen::Matrix<double, 3, 2> d_px;
  Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, kMaxLensParams> d_params;
};

struct Lens {
  LensModel model = LensModel::kPinhole;
  LensParams params = (LensParams(4) << 460.0, 460.0, 320.0, 240.0).finished();

  /// Pixel of a point in frame c (x right, y down, z forward); only its direction matters, so a far point may be given
  /// as a direction. Empty outside the domain of the model. Image bounds are not the lens's business.
  std::optional<Vector2d> project(const Vector3d& point_c) const;
  /// project() with analytic derivatives.
  std::optional<LensProjection> linearize(const Vector3d& point_c) const;
  /// Unit vector that the pixel sees; empty where no direction projects there.
  std::optional<Vector3d> unproject(const Vector2d& px) const;
  /// unproject() with derivatives, by the implicit function theorem.
  std::optional<LensRay> linearize_ray(const Vector2d& px) const;
};

/// Number of parameters of a model.
int lens_params(LensModel model);
/// "pinhole-radtan", "pinhole-equidistant", "pinhole-fov", "pinhole", "omni", "omni-radtan", "ds", "eucm".
std::string_view lens_name(LensModel model);
/// "fu", "k1", ...: what parameter `index` of a model is called.
std::string_view lens_param_name(LensModel model, int index);

}  // namespace vispline

/// A surface as a camera at one instant sees it: rays in frame c to places on the picture, without trigonometry.
/// docs/math/rendering.md, Rays and surfaces.
#pragma once

#include <array>
#include <optional>

#include "vispline/simulate/ray_table.h"
#include "vispline/simulate/scene.h"

namespace vispline {

enum class Coverage { kNone, kSome, kAll };

struct SurfaceView {
  /// h = to_picture * r of a ray r: the ray meets the plane at fractions (h0 / h2, h1 / h2) of width and height, at
  /// distance |r| / h2; behind the camera if h2 <= 0.                               docs/math/rendering.md (1)
  Matrix3d to_picture;
  const Texture* picture = nullptr;  ///< none on the back

  /// The ray meets the rectangle if and only if all five of these have a positive product with it.
  std::array<Vector3d, 5> inside;
  std::array<double, 5> inside_norm;

  SurfaceView(const Surface& surface, const Pose& T_s_c);
  static bool is_hit(const Vector3d& h) {
    return h[2] > 0.0 && h[0] >= 0.0 && h[1] >= 0.0 && h[0] <= h[2] && h[1] <= h[2];
  }
  /// Cautious: kNone and kAll are sure.
  Coverage coverage(const RayBundle& bundle) const;
  /// Bounds of 1 / distance of the plane over the bundle.
  std::array<double, 2> inverse_distances(const RayBundle& bundle) const;
};

/// Empty if the camera is in the surface's plane, where there is nothing to be seen of it.
std::optional<SurfaceView> view_of(const Surface& surface, const Pose& T_w_c);

/// m from the point to the nearest point of the rectangle.
double distance_to(const Surface& surface, const Vector3d& p_w);

}  // namespace vispline

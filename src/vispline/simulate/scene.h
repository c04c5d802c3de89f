/// What a camera can look at: landmarks with ids, and flat surfaces that hide them and carry pictures.
/// docs/math/rendering.md, Scenes.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "vispline/core/pose.h"
#include "vispline/sensors/camera.h"

namespace vispline {

class Texture;

/// A point to track. Its id never changes and is unique in its scene.
struct SceneLandmark {
  std::uint64_t id = 0;
  Vector3d point_w = Vector3d::Zero();    ///< m
  std::optional<Vector3d> normal_w = {};  ///< unit vector out of the surface it is painted on; none: seen all round
};

/// A rectangle in the plane z = 0 of its own frame s: 0 <= x <= width, 0 <= y <= height. Its front is seen from z > 0,
/// with x to the right and y up. Opaque from both sides; only the front has a picture.
struct Surface {
  Pose T_w_s{};
  Vector2d size_m = Vector2d::Ones();                ///< width, height
  std::shared_ptr<const Texture> texture = nullptr;  ///< stretched over the rectangle; none: plain grey
};

struct Scene {
  std::vector<SceneLandmark> landmarks{};
  std::vector<Surface> surfaces{};
  double min_distance_m = 0.1;  ///< from the centre of the camera; nearer and farther landmarks are not seen
  double max_distance_m = std::numeric_limits<double>::infinity();

  /// Whether nothing but the image's bounds could keep a camera with its centre at `p_w` from seeing the landmark: it
  /// is within the range of distances, its front faces p_w, and no surface is between.
  bool in_sight(const Vector3d& p_w, const SceneLandmark& landmark) const;
  /// Pixel at which a camera that stands still at T_w_c sees the landmark: in_sight(), in the lens's domain and inside
  /// the image.
  std::optional<Vector2d> visible(const Pose& T_w_c, const Camera& camera, const SceneLandmark& landmark) const;
};

/// Landmarks with their index as id, seen from all round.
Scene point_scene(const std::vector<Vector3d>& points_w);

/// Appends what `more` holds, ids raised by 1 + the largest id of `scene`, and returns by how much they were raised.
/// The range of distances stays that of `scene`.
std::uint64_t add_scene(Scene& scene, const Scene& more);

/// Throws Error(kUsage, E-CONFIG) for numbers that are not finite, surfaces without area, poses that are no rotation,
/// a range of distances that is empty, or two landmarks with one id.
void require_valid(const Scene& scene);

}  // namespace vispline

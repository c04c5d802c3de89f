#include "vispline/simulate/scene.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "vispline/core/error.h"

namespace vispline {
namespace {

constexpr double kOnSurface = 1e-6;  // of the distance: a landmark is not hidden by the surface that it lies on
constexpr double kOrthonormal = 1e-6;

/// Whether the open segment from `a_w` to `b_w` passes through the rectangle.
bool hides(const Surface& surface, const Vector3d& a_w, const Vector3d& b_w) {
  const Pose T_s_w = surface.T_w_s.inverse();
  const Vector3d a_s = T_s_w * a_w, b_s = T_s_w * b_w;
  if (a_s.z() == b_s.z()) return false;
  const double part = a_s.z() / (a_s.z() - b_s.z());
  if (!(part > 0.0 && part < 1.0 - kOnSurface)) return false;
  const Vector3d hit_s = a_s + part * (b_s - a_s);
  return hit_s.x() >= 0.0 && hit_s.y() >= 0.0 && hit_s.x() <= surface.size_m.x() && hit_s.y() <= surface.size_m.y();
}

[[noreturn]] void fail(const std::string& message) {
  throw Error(
      ExitCode::kUsage,
      {.code = "E-CONFIG", .message = message, .where = "", .effect = "nothing done", .next = "correct the scene"});
}

void check_surface(const Surface& surface, std::size_t index) {
  const std::string name = "surface " + std::to_string(index) + " of the scene ";
  const Pose& T = surface.T_w_s;
  if (!(T.R.allFinite() && T.p.allFinite() && surface.size_m.allFinite()))
    fail(name + "has a number that is not finite");
  if (!(surface.size_m.minCoeff() > 0.0)) fail(name + "has no area");
  const bool is_rotation = (T.R.transpose() * T.R).isIdentity(kOrthonormal) && T.R.determinant() > 0.0;
  if (!is_rotation) fail(name + "has a pose that is no rotation");
}

}  // namespace

bool Scene::in_sight(const Vector3d& p_w, const SceneLandmark& landmark) const {
  const Vector3d to_camera_w = p_w - landmark.point_w;
  const double distance = to_camera_w.norm();
  if (!(distance >= min_distance_m && distance <= max_distance_m)) return false;
  if (landmark.normal_w && landmark.normal_w->dot(to_camera_w) <= 0.0) return false;
  return std::ranges::none_of(surfaces, [&](const Surface& s) { return hides(s, p_w, landmark.point_w); });
}

std::optional<Vector2d> Scene::visible(const Pose& T_w_c, const Camera& camera, const SceneLandmark& landmark) const {
  const std::optional<Vector2d> px = camera.lens.project(T_w_c.inverse() * landmark.point_w);
  if (!px || !camera.in_image(*px) || !in_sight(T_w_c.p, landmark)) return std::nullopt;
  return px;
}

Scene point_scene(const std::vector<Vector3d>& points_w) {
  Scene scene;
  for (const Vector3d& point_w : points_w)
    scene.landmarks.push_back({.id = scene.landmarks.size(), .point_w = point_w});
  return scene;
}

std::uint64_t add_scene(Scene& scene, const Scene& more) {
  std::uint64_t raise = 0;
  for (const SceneLandmark& landmark : scene.landmarks) raise = std::max(raise, landmark.id + 1);
  for (SceneLandmark landmark : more.landmarks) {
    landmark.id += raise;
    scene.landmarks.push_back(landmark);
  }
  scene.surfaces.insert(scene.surfaces.end(), more.surfaces.begin(), more.surfaces.end());
  return raise;
}

void require_valid(const Scene& scene) {
  std::set<std::uint64_t> ids;
  for (const SceneLandmark& landmark : scene.landmarks) {
    const std::string name = "landmark " + std::to_string(landmark.id) + " of the scene ";
    if (!ids.insert(landmark.id).second) fail(name + "is there twice");
    if (!landmark.point_w.allFinite()) fail(name + "has a number that is not finite");
    if (landmark.normal_w && !(std::abs(landmark.normal_w->norm() - 1.0) < kOrthonormal)) {
      fail(name + "has a normal that is no unit vector");
    }
  }
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) check_surface(scene.surfaces[i], i);
  if (!(scene.min_distance_m > 0.0 && scene.max_distance_m > scene.min_distance_m)) {
    fail("the scene's range of distances must start above 0 and end above its start");
  }
}

}  // namespace vispline

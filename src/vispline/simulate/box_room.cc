#include "vispline/simulate/box_room.h"

#include <memory>
#include <string>

#include "vispline/core/error.h"
#include "vispline/core/random.h"
#include "vispline/simulate/wall_texture.h"

namespace vispline {
namespace {

/// The wall that faces along `normal_w`, an axis: y_s is up, or world y on floor and ceiling.
Surface wall(const Vector3d& normal_w, const BoxRoom& room) {
  const Vector3d up_w = normal_w.z() == 0.0 ? Vector3d::UnitZ() : Vector3d::UnitY();
  const Vector3d right_w = up_w.cross(normal_w);
  Surface surface;
  surface.T_w_s.R << right_w, up_w, normal_w;
  const auto lowest = [&](const Vector3d& axis_w) {
    return axis_w.sum() > 0.0 ? axis_w.dot(room.lower_w) : axis_w.dot(room.upper_w);
  };
  surface.T_w_s.p = lowest(right_w) * right_w + lowest(up_w) * up_w + lowest(normal_w) * normal_w;
  const Vector3d size = room.upper_w - room.lower_w;
  surface.size_m = {right_w.cwiseAbs().dot(size), up_w.dot(size)};
  return surface;
}

/// The wall that `part`, in (0, 1], of the whole area falls on.
const Surface& pick(const std::vector<Surface>& walls, double part) {
  double area = 0.0;
  for (const Surface& surface : walls) area += surface.size_m.prod();
  double rest = part * area;
  for (const Surface& surface : walls) {
    rest -= surface.size_m.prod();
    if (rest <= 0.0) return surface;
  }
  return walls.back();
}

}  // namespace

Scene box_room(const BoxRoom& room) {
  require((room.upper_w - room.lower_w).minCoeff() > 0.0, "a room whose upper corner is above its lower one");
  require(room.cell_m >= 0.0, "a size of cells from 0");
  Scene scene;
  for (const Vector3d axis_w : {Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()}) {
    scene.surfaces.push_back(wall(axis_w, room));
    scene.surfaces.push_back(wall(-axis_w, room));
  }
  for (std::size_t i = 0; room.cell_m > 0.0 && i < scene.surfaces.size(); ++i) {
    Surface& surface = scene.surfaces[i];
    surface.texture = std::make_shared<const Texture>(
        wall_texture(surface.size_m, room.cell_m, room.seed, "scene/room/wall" + std::to_string(i)));
  }
  const RandomStream stream(room.seed, "scene/room");
  for (std::size_t i = 0; i < room.landmarks; ++i) {
    const Surface& surface = pick(scene.surfaces, stream.uniform_pair(2 * i)[0]);
    const auto [x, y] = stream.uniform_pair(2 * i + 1);
    scene.landmarks.push_back({.id = i,
                               .point_w = surface.T_w_s * Vector3d(x * surface.size_m.x(), y * surface.size_m.y(), 0.0),
                               .normal_w = surface.T_w_s.R.col(2)});
  }
  return scene;
}

}  // namespace vispline

#include "vispline/simulate/random_cloud.h"

#include "vispline/core/error.h"
#include "vispline/core/random.h"

namespace vispline {

Scene random_cloud(const RandomCloud& cloud) {
  require((cloud.upper_w - cloud.lower_w).minCoeff() >= 0.0,
          "a box of points whose upper corner is above its lower one");
  const RandomStream stream(cloud.seed, "scene/cloud");
  std::vector<Vector3d> points_w;
  for (std::size_t i = 0; i < cloud.count; ++i) {
    const auto [x, y] = stream.uniform_pair(2 * i);
    const auto [z, unused] = stream.uniform_pair(2 * i + 1);
    points_w.push_back(cloud.lower_w + (cloud.upper_w - cloud.lower_w).cwiseProduct(Vector3d(x, y, z)));
  }
  return point_scene(points_w);
}

}  // namespace vispline

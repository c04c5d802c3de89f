/// A scene of points that fill a box evenly, for tests that no structure of a room may help.
#pragma once

#include <cstdint>

#include "vispline/simulate/scene.h"

namespace vispline {

struct RandomCloud {
  std::size_t count = 500;
  Vector3d lower_w{-10.0, -10.0, -5.0};  ///< m, opposite corners of the box
  Vector3d upper_w{10.0, 10.0, 5.0};
  std::uint64_t seed = 0;  ///< the first n points do not depend on `count`
};

/// Throws E-ARGUMENT for a box with a negative side.
Scene random_cloud(const RandomCloud& cloud);

}  // namespace vispline

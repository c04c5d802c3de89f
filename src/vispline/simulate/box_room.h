/// A room of six walls with points on them, looked at from inside.
#pragma once

#include <cstdint>

#include "vispline/simulate/scene.h"

namespace vispline {

struct BoxRoom {
  Vector3d lower_w{-4.0, -4.0, -1.5};  ///< m, opposite corners of the room
  Vector3d upper_w{4.0, 4.0, 2.5};
  std::size_t landmarks = 600;  ///< on all walls together, as dense on each
  double cell_m = 0.01;         ///< of the pictures on the walls; 0: plain walls
  std::uint64_t seed = 0;       ///< of places and pictures; the first n points do not depend on their number
};

/// The walls look inwards. In this order: x lower, x upper, y lower, y upper, floor, ceiling. Throws E-ARGUMENT for a
/// room without volume and cells so small that a wall has more than 2^24.
Scene box_room(const BoxRoom& room);

}  // namespace vispline

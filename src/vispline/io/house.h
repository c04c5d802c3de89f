/// The house of the course simulator: 23 segments, and the points that its camera sees. docs/formats.md, Course files.
#pragma once

#include <array>
#include <vector>

#include "vispline/core/types.h"

namespace vispline {

/// A straight edge in the world, m.
struct Segment {
  Vector3d start_w;
  Vector3d end_w;
};

/// Walls 10 m x 10 m x 6.5 m, a gable roof whose ridge is 10 m high, a door and a window in the wall x = 0. In the
/// order of the course's file: vertical edges, floor, slopes, ridge, eaves, door, window.
std::vector<Segment> house_segments();

/// The distinct ends of the segments in order of first appearance, then each again at +(0.5, 0.5, -0.5) m.
std::vector<Vector3d> house_points();

}  // namespace vispline

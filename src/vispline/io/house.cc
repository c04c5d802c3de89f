#include "vispline/io/house.h"

#include <algorithm>

namespace vispline {
namespace {

constexpr double kSide = 10.0, kWall = 6.5, kRidge = 10.0;  // m

/// Closed outline through the corners.
void add_outline(std::vector<Segment>& segments, const std::array<Vector3d, 4>& corners) {
  for (std::size_t i = 0; i < corners.size(); ++i) segments.push_back({corners[i], corners[(i + 1) % corners.size()]});
}

std::array<Vector3d, 4> floor_corners() {
  return {Vector3d(0, 0, 0), Vector3d(kSide, 0, 0), Vector3d(kSide, kSide, 0), Vector3d(0, kSide, 0)};
}

void add_roof(std::vector<Segment>& segments) {
  const double middle = kSide / 2;
  for (const double x : {0.0, kSide}) {
    segments.push_back({{x, 0, kWall}, {x, middle, kRidge}});
    segments.push_back({{x, middle, kRidge}, {x, kSide, kWall}});
  }
  segments.push_back({{0, middle, kRidge}, {kSide, middle, kRidge}});
  for (const double y : {0.0, kSide}) segments.push_back({{0, y, kWall}, {kSide, y, kWall}});
}

}  // namespace

std::vector<Segment> house_segments() {
  std::vector<Segment> segments;
  for (const Vector3d& corner : floor_corners()) segments.push_back({corner, corner + Vector3d(0, 0, kWall)});
  add_outline(segments, floor_corners());
  add_roof(segments);
  add_outline(segments, {Vector3d(0, 6, 0), Vector3d(0, 8, 0), Vector3d(0, 8, 5), Vector3d(0, 6, 5)});
  add_outline(segments, {Vector3d(0, 2, 2.5), Vector3d(0, 4, 2.5), Vector3d(0, 4, 5), Vector3d(0, 2, 5)});
  return segments;
}

std::vector<Vector3d> house_points() {
  std::vector<Vector3d> points;
  const auto add = [&](const Vector3d& p) {
    if (std::find(points.begin(), points.end(), p) == points.end()) points.push_back(p);
  };
  for (const Segment& segment : house_segments()) {
    add(segment.start_w);
    add(segment.end_w);
  }
  const std::size_t distinct = points.size();
  for (std::size_t i = 0; i < distinct; ++i) points.push_back(points[i] + Vector3d(0.5, 0.5, -0.5));
  return points;
}

}  // namespace vispline

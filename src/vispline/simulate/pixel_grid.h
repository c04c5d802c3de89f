/// Points of an image that keep a distance from each other.
#pragma once

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "vispline/core/types.h"

namespace vispline {

class PixelGrid {
 public:
  /// 0: any number of points at one place.
  explicit PixelGrid(double min_distance_px) : distance_px_(min_distance_px) {}

  /// Adds the point unless another one is nearer than the distance.
  bool add(const Vector2d& px) {
    if (distance_px_ <= 0.0) return true;
    const Cell cell = cell_of(px);
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        if (is_near({cell.first + dx, cell.second + dy}, px)) return false;
      }
    }
    cells_[cell].push_back(px);
    return true;
  }

 private:
  using Cell = std::pair<long, long>;

  Cell cell_of(const Vector2d& px) const {
    return {std::lround(std::floor(px.x() / distance_px_)), std::lround(std::floor(px.y() / distance_px_))};
  }
  bool is_near(const Cell& cell, const Vector2d& px) const {
    const auto found = cells_.find(cell);
    if (found == cells_.end()) return false;
    for (const Vector2d& other : found->second) {
      if ((other - px).norm() < distance_px_) return true;
    }
    return false;
  }

  double distance_px_;
  std::map<Cell, std::vector<Vector2d>> cells_;
};

}  // namespace vispline

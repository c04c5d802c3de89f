/// The direction that every pixel of a camera sees, computed once: a lens is slow to unproject, an image has many.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "vispline/sensors/camera.h"

namespace vispline {

/// Frame c. Single precision is 5e-5 px.
struct PixelRay {
  Eigen::Vector3f bearing;  ///< unit vector; not a number where the lens sees nothing
  Eigen::Vector3f d_x;      ///< per px to the right
  Eigen::Vector3f d_y;      ///< per px down
  bool sees() const { return bearing.x() == bearing.x(); }
};

/// All rays of some neighbours in one line, to ask about them at once.
struct RayBundle {
  int begin = 0, end = 0;  ///< places in the line
  Vector3d axis_c = Vector3d::Zero();
  double reach = -1.0;  ///< no ray of the bundle, corners of pixels included, ends farther from axis_c; < 0: none sees
};

/// Lines in the order of reading; place k of a line is its column, or its row if the image is read sideways.
class RayTable {
 public:
  explicit RayTable(const Camera& camera);

  int lines() const { return lines_; }
  int places() const { return places_; }
  const PixelRay& ray(int line, int place) const {
    return rays_[static_cast<std::size_t>(line) * static_cast<std::size_t>(places_) + static_cast<std::size_t>(place)];
  }
  const std::vector<RayBundle>& bundles(int line) const { return bundles_[static_cast<std::size_t>(line)]; }
  /// Column and row of a place in a line.
  Eigen::Vector2i pixel(int line, int place) const;
  /// The finest angle that the lens resolves, rad/px.
  double rad_per_px() const { return rad_per_px_; }

 private:
  RayBundle bundle(int line, int begin) const;

  ReadoutDirection direction_;
  int lines_, places_;
  std::vector<PixelRay> rays_;
  std::vector<std::vector<RayBundle>> bundles_;
  double rad_per_px_ = std::numeric_limits<double>::infinity();
};

}  // namespace vispline

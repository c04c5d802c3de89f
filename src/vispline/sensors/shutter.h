/// When the lines of an image are exposed. docs/math/camera.md, Shutter.
#pragma once

#include <array>

#include "vispline/core/types.h"

namespace vispline {

/// Where the reading goes; by far the most sensors read downwards.
enum class ReadoutDirection { kDown, kUp, kRight, kLeft };

/// The time of a line is the middle of its exposure. The stamp of a frame is the time of its first line (mid-exposure).
struct Shutter {
  double line_delay_s = 0.0;  ///< from line to line; 0: global shutter
  ReadoutDirection direction = ReadoutDirection::kDown;
  double exposure_s = 0.0;  ///< how long a line is exposed: motion blur of rendered images only

  /// Line of a pixel in the order of reading: 0 at the centre of the first line. Continuous, so that it can be
  /// differentiated.
  double line(const Vector2d& px, const std::array<int, 2>& resolution_px) const;
  /// d line / d px, a unit vector along or against an axis.
  Vector2d line_gradient() const;
  /// Lines of an image: its height, or its width for a sideways reading.
  int lines(const std::array<int, 2>& resolution_px) const;
};

}  // namespace vispline

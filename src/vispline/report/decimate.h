/// Long curves drawn with few points and without losing what the eye would see.
#pragma once

#include <span>
#include <vector>

namespace vispline::report {

/// Pixels of a drawing: x to the right, y down.
struct Point {
  double x;
  double y;
  bool operator==(const Point&) const = default;
};

/// Each run of successive points in one pixel column becomes its first, lowest, highest and last point, in their order.
/// The drawn curve differs by less than a pixel; spikes stay.
std::vector<Point> decimate_columns(std::span<const Point> points);

/// One curve as pieces: segments between cells of 2 x 2 pixels that are both inked already are left out, so that a
/// curve that goes round for hours costs no more than the area it fills.
std::vector<std::vector<Point>> decimate_inked(std::span<const Point> points);

/// At most one point in each pixel.
std::vector<Point> decimate_pixels(std::span<const Point> points);

}  // namespace vispline::report

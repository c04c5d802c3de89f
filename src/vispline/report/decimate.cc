#include "vispline/report/decimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_set>
#include <utility>

namespace vispline::report {
namespace {

/// Drawings are below 1e6 pixels; what lies outside is clipped, so the edge cell may stand for it.
std::int64_t cell_index(double px, double size) {
  return static_cast<std::int64_t>(std::floor(std::clamp(px, -1e6, 1e6) / size));
}

std::int64_t cell_of(Point p, double size) { return cell_index(p.x, size) * 4'000'000 + cell_index(p.y, size); }

void append_run(std::span<const Point> run, std::vector<Point>& out) {
  const auto below = [](Point a, Point b) { return a.y < b.y; };
  const auto [lowest, highest] = std::minmax_element(run.begin(), run.end(), below);
  std::array<std::ptrdiff_t, 4> keep{0, lowest - run.begin(), highest - run.begin(),
                                     static_cast<std::ptrdiff_t>(run.size()) - 1};
  std::sort(keep.begin(), keep.end());
  const auto end = std::unique(keep.begin(), keep.end());
  for (auto it = keep.begin(); it != end; ++it) out.push_back(run[static_cast<std::size_t>(*it)]);
}

}  // namespace

std::vector<Point> decimate_columns(std::span<const Point> points) {
  std::vector<Point> out;
  std::size_t begin = 0;
  for (std::size_t i = 1; i <= points.size(); ++i) {
    if (i < points.size() && cell_index(points[i].x, 1.0) == cell_index(points[begin].x, 1.0)) continue;
    append_run(points.subspan(begin, i - begin), out);
    begin = i;
  }
  return out;
}

std::vector<std::vector<Point>> decimate_inked(std::span<const Point> points) {
  std::unordered_set<std::int64_t> inked;
  std::vector<std::vector<Point>> pieces;
  bool pen_down = false;
  bool from_inked = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool to_inked = !inked.insert(cell_of(points[i], 2.0)).second;
    const bool draw = i > 0 && !(from_inked && to_inked);
    if (draw && !pen_down) pieces.push_back({points[i - 1]});
    if (draw) pieces.back().push_back(points[i]);
    pen_down = draw;
    from_inked = to_inked;
  }
  return pieces;
}

std::vector<Point> decimate_pixels(std::span<const Point> points) {
  std::unordered_set<std::int64_t> inked;
  std::vector<Point> out;
  for (const Point p : points) {
    if (inked.insert(cell_of(p, 1.0)).second) out.push_back(p);
  }
  return out;
}

}  // namespace vispline::report

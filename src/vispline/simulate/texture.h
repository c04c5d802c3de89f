/// A picture on a surface, made of rectangular cells of one grey each, whose mean over a box is exact: what a pixel
/// sees has no aliasing however small the cells look. docs/math/rendering.md, Textures.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace vispline {

/// How the cells of a picture meet.
enum class CellEdges {
  kSharp,   ///< print: every cell is flat
  kSmooth,  ///< photograph: grey goes over from the middle of one cell to the middle of the next; equal cells only
};

/// Coordinates are fractions of the surface's width and height, from the lower left corner.
class Texture {
 public:
  /// `x_edges`, `y_edges`: from 0 to 1, strictly increasing, one more than cells. `grey`: 0 black to 255 white, row by
  /// row from the lower left. Throws E-ARGUMENT for anything else.
  Texture(std::vector<double> x_edges, std::vector<double> y_edges, std::vector<float> grey,
          CellEdges edges = CellEdges::kSharp);
  /// Equal cells.
  static Texture grid(int cols, int rows, std::vector<float> grey, CellEdges edges);

  bool is_smooth() const { return kind_ == CellEdges::kSmooth; }
  /// Mean grey over the box of half sizes `half_x`, `half_y` around (x, y). A box that reaches over the rim is moved
  /// inside.
  double mean(double x, double y, double half_x, double half_y) const;
  /// That mean if the box lies in one cell; a fraction of the work.
  std::optional<double> flat(double x, double y, double half_x, double half_y) const;

 private:
  struct Range {
    double begin, end;
    int first, last;  ///< cells that hold begin and end
  };
  class Axis {
   public:
    Axis() = default;
    Axis(std::vector<double> edges, CellEdges kind);
    int cells() const { return static_cast<int>(edges_.size()) - 1; }
    double edge(int i) const { return edges_[static_cast<std::size_t>(i)]; }
    Range range(double centre, double half) const;
    /// Where in its cell `x` is, 0 to 1.
    double part(int cell, double x) const { return (x - edge(cell)) * inverse_width_[static_cast<std::size_t>(cell)]; }
    /// Of the range, in the last of its two cells.
    double last_weight(const Range& range) const {
      return range.first == range.last ? 0.0 : (range.end - edge(range.last)) / (range.end - range.begin);
    }

   private:
    int cell(double x) const {
      const double bin = x * static_cast<double>(bins_.size());
      if (is_equal_) return std::min(static_cast<int>(bin), cells() - 1);
      int i = bins_[std::min(static_cast<std::size_t>(bin), bins_.size() - 1)];
      while (i + 1 < cells() && edge(i + 1) <= x) ++i;
      return i;
    }

    bool is_equal_ = false;  ///< as many cells as bins
    std::vector<double> edges_, inverse_width_;
    std::vector<int> bins_;  ///< cell that holds the start of each of equal bins, none wider than a cell
    double least_half_ = 0.0;
  };

  double grey(int cx, int cy) const {
    return grey_[static_cast<std::size_t>(cy) * static_cast<std::size_t>(x_.cells()) + static_cast<std::size_t>(cx)];
  }
  double integral(int cx, double x, int cy, double y) const;

  CellEdges kind_;
  Axis x_, y_;
  std::vector<float> grey_;
  std::vector<double> integral_;  ///< of grey from (0, 0) to each crossing of edges
};

}  // namespace vispline

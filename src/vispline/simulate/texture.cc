#include "vispline/simulate/texture.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "vispline/core/error.h"

namespace vispline {
namespace {

constexpr double kMostBins = 1e6;
constexpr double kRounding = 1e-9;  // of the edges of equal cells

std::vector<double> equal_edges(int cells) {
  std::vector<double> edges;
  for (int i = 0; i <= cells; ++i) edges.push_back(static_cast<double>(i) / cells);
  return edges;
}

}  // namespace

Texture::Axis::Axis(std::vector<double> edges, CellEdges kind) : edges_(std::move(edges)) {
  require(edges_.size() >= 2 && edges_.front() == 0.0 && edges_.back() == 1.0, "edges of cells from 0 to 1");
  double least = 1.0;
  for (std::size_t i = 0; i + 1 < edges_.size(); ++i) {
    const double width = edges_[i + 1] - edges_[i];
    require(width * kMostBins > 1.0, "strictly increasing edges of cells, none narrower than a millionth");
    inverse_width_.push_back(1.0 / width);
    least = std::min(least, width);
  }
  const auto bins = static_cast<int>(std::ceil((1.0 - kRounding) / least));
  is_equal_ = bins == cells();
  for (int bin = 0, i = 0; bin < bins; ++bin) {
    while (i + 1 < cells() && edge(i + 1) <= static_cast<double>(bin) / bins) ++i;
    bins_.push_back(i);
  }
  if (kind == CellEdges::kSmooth) least_half_ = 0.5 * std::min(1.0, least);
}

Texture::Range Texture::Axis::range(double centre, double half) const {
  half = std::min(std::max(half, least_half_), 0.5);
  centre = std::min(std::max(centre, half), 1.0 - half);
  const double begin = std::max(centre - half, 0.0), end = std::min(centre + half, 1.0);
  return {begin, end, cell(begin), cell(end)};
}

Texture::Texture(std::vector<double> x_edges, std::vector<double> y_edges, std::vector<float> grey, CellEdges edges)
    : kind_(edges), x_(std::move(x_edges), edges), y_(std::move(y_edges), edges), grey_(std::move(grey)) {
  const auto cols = static_cast<std::size_t>(x_.cells()), rows = static_cast<std::size_t>(y_.cells());
  require(grey_.size() == cols * rows, "one grey a cell");
  require(std::ranges::all_of(grey_, [](float g) { return g >= 0.0f && g <= 255.0f; }), "greys from 0 to 255");
  integral_.assign((cols + 1) * (rows + 1), 0.0);
  for (std::size_t r = 0; r < rows; ++r) {
    const double height = y_.edge(static_cast<int>(r) + 1) - y_.edge(static_cast<int>(r));
    double row = 0.0;
    for (std::size_t c = 0; c < cols; ++c) {
      row += grey_[r * cols + c] * (x_.edge(static_cast<int>(c) + 1) - x_.edge(static_cast<int>(c))) * height;
      integral_[(r + 1) * (cols + 1) + c + 1] = integral_[r * (cols + 1) + c + 1] + row;
    }
  }
}

Texture Texture::grid(int cols, int rows, std::vector<float> grey, CellEdges edges) {
  require(cols > 0 && rows > 0, "a texture with cells");
  return {equal_edges(cols), equal_edges(rows), std::move(grey), edges};
}

/// Inside a cell the integral is bilinear.
double Texture::integral(int cx, double x, int cy, double y) const {
  const double* low = &integral_[static_cast<std::size_t>(cy * (x_.cells() + 1) + cx)];
  const double* high = low + x_.cells() + 1;
  const double part = x_.part(cx, x);
  const double below = low[0] + part * (low[1] - low[0]), above = high[0] + part * (high[1] - high[0]);
  return below + y_.part(cy, y) * (above - below);
}

double Texture::mean(double x, double y, double half_x, double half_y) const {
  const Range h = x_.range(x, half_x), v = y_.range(y, half_y);
  if (h.last - h.first > 1 || v.last - v.first > 1) {
    const double sum = integral(h.last, h.end, v.last, v.end) - integral(h.first, h.begin, v.last, v.end) -
                       integral(h.last, h.end, v.first, v.begin) + integral(h.first, h.begin, v.first, v.begin);
    return sum / ((h.end - h.begin) * (v.end - v.begin));
  }
  const double right = x_.last_weight(h), top = y_.last_weight(v);
  const double below = grey(h.first, v.first) + right * (grey(h.last, v.first) - grey(h.first, v.first));
  const double above = grey(h.first, v.last) + right * (grey(h.last, v.last) - grey(h.first, v.last));
  return below + top * (above - below);
}

std::optional<double> Texture::flat(double x, double y, double half_x, double half_y) const {
  const Range h = x_.range(x, half_x);
  if (h.first != h.last) return std::nullopt;
  const Range v = y_.range(y, half_y);
  if (v.first != v.last) return std::nullopt;
  return grey(h.first, v.first);
}

}  // namespace vispline

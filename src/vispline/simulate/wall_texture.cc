#include "vispline/simulate/wall_texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "vispline/core/error.h"
#include "vispline/core/random.h"

namespace vispline {
namespace {

constexpr double kMostCells = 1 << 24;
constexpr std::array<double, 4> kCloudSizes_m{1.6, 0.4, 0.1, 0.025};
constexpr double kCloudContrast = 30.0;
constexpr double kPatchesPerSquareMetre = 12.0;
constexpr double kLeastPatch_m = 0.04, kPatchSpread_m = 0.3;

struct Sheet {
  int cols, rows;
  std::vector<float> grey = std::vector<float>(static_cast<std::size_t>(cols) * static_cast<std::size_t>(rows), 128.0f);
  float& at(int col, int row) { return grey[static_cast<std::size_t>(row * cols + col)]; }
};

/// Where the cells of a row or column lie on a lattice: the point before, and the smooth step to the next.
struct LatticePlace {
  std::size_t point;
  double step;
};

std::vector<LatticePlace> lattice_places(int cells, double cells_per_point) {
  std::vector<LatticePlace> places;
  for (int cell = 0; cell < cells; ++cell) {
    const double x = cell / cells_per_point, part = x - std::floor(x);
    places.push_back({static_cast<std::size_t>(x), part * part * (3.0 - 2.0 * part)});
  }
  return places;
}

/// Adds random numbers from -contrast to contrast on a lattice with smooth steps between: value noise.
void add_cloud(Sheet& sheet, double cells_per_point, double contrast, const RandomStream& stream) {
  const auto cols = lattice_places(sheet.cols, cells_per_point), rows = lattice_places(sheet.rows, cells_per_point);
  const std::size_t width = cols.back().point + 2;
  std::vector<double> lattice(width * (rows.back().point + 2));
  for (std::size_t i = 0; i < lattice.size(); ++i) lattice[i] = contrast * (2.0 * stream.uniform_pair(i)[0] - 1.0);
  std::vector<double> line(width);
  float* cell = sheet.grey.data();
  for (const LatticePlace& row : rows) {
    const double* low = lattice.data() + row.point * width;
    for (std::size_t i = 0; i < width; ++i) line[i] = low[i] + row.step * (low[i + width] - low[i]);
    for (const LatticePlace& col : cols) {
      const double* left = line.data() + col.point;
      *cell++ += static_cast<float>(left[0] + col.step * (left[1] - left[0]));
    }
  }
}

/// Rectangles of random place, size and grey that are laid over what is there, half transparent.
void add_patches(Sheet& sheet, std::size_t count, double cell_m, const RandomStream& stream) {
  for (std::size_t i = 0; i < count; ++i) {
    const auto [x, y] = stream.uniform_pair(3 * i);
    const auto [w, h] = stream.uniform_pair(3 * i + 1);
    const auto grey = static_cast<float>(255.0 * stream.uniform_pair(3 * i + 2)[0]);
    const auto extent = [&](double u) { return static_cast<int>((kLeastPatch_m + kPatchSpread_m * u * u) / cell_m); };
    const int left = static_cast<int>(x * sheet.cols), low = static_cast<int>(y * sheet.rows);
    for (int row = low; row < std::min(sheet.rows, low + extent(h)); ++row) {
      for (int col = left; col < std::min(sheet.cols, left + extent(w)); ++col) {
        sheet.at(col, row) = 0.5f * (sheet.at(col, row) + grey);
      }
    }
  }
}

}  // namespace

Texture wall_texture(const Vector2d& size_m, double cell_m, std::uint64_t seed, const std::string& name) {
  require(cell_m > 0.0 && size_m.minCoeff() > 0.0, "a wall and cells with a size");
  require((size_m / cell_m).prod() <= kMostCells, "a picture of at most 2^24 cells on a wall");
  Sheet sheet{std::max(1, static_cast<int>(std::lround(size_m.x() / cell_m))),
              std::max(1, static_cast<int>(std::lround(size_m.y() / cell_m)))};
  for (const double size : kCloudSizes_m) {
    add_cloud(sheet, std::max(1.0, size / cell_m), kCloudContrast,
              RandomStream(seed, name + "/cloud/" + std::to_string(size)));
  }
  add_patches(sheet, static_cast<std::size_t>(kPatchesPerSquareMetre * size_m.prod()), cell_m,
              RandomStream(seed, name + "/patches"));
  for (float& grey : sheet.grey) grey = std::clamp(grey, 0.0f, 255.0f);
  return Texture::grid(sheet.cols, sheet.rows, std::move(sheet.grey), CellEdges::kSmooth);
}

}  // namespace vispline

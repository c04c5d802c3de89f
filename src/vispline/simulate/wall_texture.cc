#include "vispline/simulate/wall_texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "vispline/core/error.h"
#include "vispline/core/random.h"

namespace vispline {
namespace {

constexpr double kMostCells = 1 << 24;
constexpr std::array<double, 4> kCloudSizes_m{1.6, 0.4, 0.1, 0.025};
constexpr double kPatchesPerSquareMetre = 12.0;
constexpr double kLeastPatch_m = 0.04, kPatchSpread_m = 0.3;

struct Sheet {
  int cols, rows;
  std::vector<float> grey = std::vector<float>(static_cast<std::size_t>(cols) * static_cast<std::size_t>(rows), 128.0f);
  float& at(int col, int row) { return grey[static_cast<std::size_t>(row * cols + col)]; }
};

/// Random numbers from -1 to 1 on a lattice, with smooth steps between: value noise.
class Cloud {
 public:
  Cloud(double cells, int cols, int rows, const RandomStream& stream)
      : cells_(cells), width_(static_cast<std::size_t>(cols / cells) + 2) {
    const std::size_t count = width_ * (static_cast<std::size_t>(rows / cells) + 2);
    for (std::size_t i = 0; i < count; ++i) lattice_.push_back(2.0 * stream.uniform_pair(i)[0] - 1.0);
  }
  double at(int col, int row) const {
    const double x = col / cells_, y = row / cells_;
    const auto i = static_cast<std::size_t>(x), j = static_cast<std::size_t>(y);
    const double s = step(x - std::floor(x)), t = step(y - std::floor(y));
    const double* low = &lattice_[j * width_ + i];
    const double* high = low + width_;
    const double below = low[0] + s * (low[1] - low[0]), above = high[0] + s * (high[1] - high[0]);
    return below + t * (above - below);
  }

 private:
  static double step(double x) { return x * x * (3.0 - 2.0 * x); }
  double cells_;
  std::size_t width_;
  std::vector<double> lattice_;
};

void add_cloud(Sheet& sheet, const Cloud& cloud, float contrast) {
  for (int row = 0; row < sheet.rows; ++row) {
    for (int col = 0; col < sheet.cols; ++col) sheet.at(col, row) += contrast * static_cast<float>(cloud.at(col, row));
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
    const double cells = std::max(1.0, size / cell_m);
    add_cloud(sheet, Cloud(cells, sheet.cols, sheet.rows, RandomStream(seed, name + "/cloud/" + std::to_string(size))),
              30.0f);
  }
  add_patches(sheet, static_cast<std::size_t>(kPatchesPerSquareMetre * size_m.prod()), cell_m,
              RandomStream(seed, name + "/patches"));
  for (float& grey : sheet.grey) grey = std::clamp(grey, 0.0f, 255.0f);
  return Texture::grid(sheet.cols, sheet.rows, std::move(sheet.grey), CellEdges::kSmooth);
}

}  // namespace vispline

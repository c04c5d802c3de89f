#include "vispline/simulate/board_textures.h"

#include <algorithm>
#include <cmath>

#include "vispline/core/error.h"
#include "vispline/simulate/tag36h11.h"

namespace vispline {
namespace {

constexpr int kRimCells = 2;           // paper, then the row of black squares outside of the tags
constexpr int kPitch = kTagCells + 1;  // a tag and the gap behind it
constexpr int kCellsOfSpacing = 32;    // of a circle grid
constexpr int kSamplesOfCell = 8;
constexpr double kMostDiscs = 16000.0;  // 2^24 cells

/// Fractions of the sheet at which cells of an AprilGrid with `tags` tags in this direction meet.
std::vector<double> aprilgrid_edges(int tags, double spacing) {
  std::vector<double> edges{0.0, spacing};
  for (int tag = 0; tag < tags; ++tag) {
    const double begin = 2.0 * spacing + tag * (1.0 + spacing);
    for (int k = 0; k <= kTagCells; ++k) edges.push_back(begin + static_cast<double>(k) / kTagCells);
  }
  for (int k = 0; k < kRimCells; ++k) edges.push_back(edges.back() + spacing);
  for (double& edge : edges) edge /= edges.back();
  return edges;
}

/// A picture with settable cells; paper at first.
struct Sheet {
  int cols, rows;
  std::vector<float> grey = std::vector<float>(static_cast<std::size_t>(cols) * static_cast<std::size_t>(rows), kPaper);
  float& at(int col, int row) { return grey[static_cast<std::size_t>(row * cols + col)]; }
};

void draw_tag(Sheet& sheet, int col, int row, int id) {
  const TagCells cells = tag36h11_cells(id);
  for (int r = 0; r < kTagCells; ++r) {
    for (int c = 0; c < kTagCells; ++c) {
      const bool is_white = cells[static_cast<std::size_t>(kTagCells - 1 - r)][static_cast<std::size_t>(c)];
      sheet.at(kRimCells + col * kPitch + c, kRimCells + row * kPitch + r) = is_white ? kPaper : kInk;
    }
  }
}

/// Part of the disc around the origin that covers the cell at (x, y) in units of cells, by sampling.
double covered(double x, double y, double radius) {
  int inside = 0;
  for (int i = 0; i < kSamplesOfCell * kSamplesOfCell; ++i) {
    const double dx = x + (i % kSamplesOfCell + 0.5) / kSamplesOfCell,
                 dy = y + (i / kSamplesOfCell + 0.5) / kSamplesOfCell;
    inside += dx * dx + dy * dy <= radius * radius;
  }
  return static_cast<double>(inside) / (kSamplesOfCell * kSamplesOfCell);
}

/// Centre in cells.
void draw_disc(Sheet& sheet, int x, int y, double radius) {
  const int reach = static_cast<int>(std::ceil(radius));
  for (int r = -reach; r < reach; ++r) {
    for (int c = -reach; c < reach; ++c) {
      sheet.at(x + c, y + r) = kPaper + static_cast<float>(covered(c, r, radius)) * (kInk - kPaper);
    }
  }
}

}  // namespace

Texture aprilgrid_texture(const AprilGrid& board) {
  std::vector<double> x = aprilgrid_edges(board.cols, board.tag_spacing),
                      y = aprilgrid_edges(board.rows, board.tag_spacing);
  Sheet sheet{static_cast<int>(x.size()) - 1, static_cast<int>(y.size()) - 1};
  for (int r = 0; r <= board.rows; ++r) {
    for (int c = 0; c <= board.cols; ++c) {
      sheet.at(1 + c * kPitch, 1 + r * kPitch) = kInk;
      if (r < board.rows && c < board.cols) draw_tag(sheet, c, r, r * board.cols + c);
    }
  }
  return {std::move(x), std::move(y), std::move(sheet.grey)};
}

Texture checkerboard_texture(const Checkerboard& board) {
  Sheet sheet{board.cols + 3, board.rows + 3};
  for (int r = 1; r <= board.rows + 1; ++r) {
    for (int c = 1; c <= board.cols + 1; ++c) sheet.at(c, r) = (r + c) % 2 == 0 ? kInk : kPaper;
  }
  return Texture::grid(sheet.cols, sheet.rows, std::move(sheet.grey), CellEdges::kSharp);
}

Texture circle_grid_texture(const CircleGrid& board) {
  const int width = board.is_asymmetric ? 2 * board.cols - (board.rows == 1 ? 1 : 0) : board.cols;
  require((width + 1.0) * (board.rows + 1.0) <= kMostDiscs, "a grid of at most 16000 circles");
  Sheet sheet{(width + 1) * kCellsOfSpacing, (board.rows + 1) * kCellsOfSpacing};
  const double radius = board.radius_m / board.spacing_m * kCellsOfSpacing;
  for (int r = 0; r < board.rows; ++r) {
    for (int c = 0; c < board.cols; ++c) {
      const int column = board.is_asymmetric ? 2 * c + r % 2 : c;
      draw_disc(sheet, (column + 1) * kCellsOfSpacing, (r + 1) * kCellsOfSpacing, radius);
    }
  }
  return Texture::grid(sheet.cols, sheet.rows, std::move(sheet.grey), CellEdges::kSharp);
}

}  // namespace vispline

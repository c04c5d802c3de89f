#include "vispline/simulate/texture.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "vispline/core/error.h"
#include "vispline/core/random.h"
#include "vispline/simulate/board_textures.h"
#include "vispline/simulate/tag36h11.h"
#include "vispline/simulate/wall_texture.h"

namespace vispline {
namespace {

const std::vector<double> kX{0.0, 0.1, 0.15, 0.4, 0.85, 1.0}, kY{0.0, 0.3, 0.35, 1.0};
const std::vector<float> kGrey{10, 200, 30, 0, 255, 90, 17, 180, 66, 5, 211, 44, 3, 99, 128};

/// Mean by areas of overlap, cell by cell.
double overlap_mean(double x0, double y0, double x1, double y1) {
  double sum = 0.0;
  for (std::size_t r = 0; r + 1 < kY.size(); ++r) {
    for (std::size_t c = 0; c + 1 < kX.size(); ++c) {
      const double w = std::min(x1, kX[c + 1]) - std::max(x0, kX[c]), h = std::min(y1, kY[r + 1]) - std::max(y0, kY[r]);
      if (w > 0.0 && h > 0.0) sum += w * h * kGrey[r * 5 + c];
    }
  }
  return sum / ((x1 - x0) * (y1 - y0));
}

TEST(Texture, MeanIsThatOfTheAreasForAnyBox) {
  const Texture texture(kX, kY, kGrey);
  const RandomStream random(1, "boxes");
  int flat = 0;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const auto [u, v] = random.uniform_pair(2 * i);
    const auto [a, b] = random.uniform_pair(2 * i + 1);
    const double hx = 1e-4 + 0.499 * std::pow(a, 4), hy = 1e-4 + 0.499 * std::pow(b, 4);
    const double x = hx + u * (1.0 - 2.0 * hx), y = hy + v * (1.0 - 2.0 * hy);
    const double expected = overlap_mean(x - hx, y - hy, x + hx, y + hy);
    ASSERT_NEAR(texture.mean(x, y, hx, hy), expected, 1e-7) << i;
    if (const auto grey = texture.flat(x, y, hx, hy)) {
      ASSERT_NEAR(*grey, expected, 1e-7);
      ++flat;
    }
  }
  EXPECT_GT(flat, 300);
  EXPECT_LT(flat, 2700);
}

TEST(Texture, BoxesOverTheRimAreMovedInside) {
  const Texture texture(kX, kY, kGrey);
  EXPECT_DOUBLE_EQ(texture.mean(-0.2, 2.0, 0.05, 0.1), overlap_mean(0.0, 0.8, 0.1, 1.0));
  EXPECT_NEAR(texture.mean(0.3, 0.9, 5.0, 7.0), overlap_mean(0.0, 0.0, 1.0, 1.0), 1e-9);
}

TEST(Texture, ASmoothOneIsLinearFromMiddleToMiddle) {
  const Texture ramp = Texture::grid(4, 1, {0, 40, 80, 120}, CellEdges::kSmooth);
  for (const double x : {0.125, 0.2, 0.37, 0.5, 0.8, 0.875}) {
    EXPECT_NEAR(ramp.mean(x, 0.5, 1e-9, 1e-9), 160.0 * (x - 0.125), 1e-9) << x;
  }
}

TEST(Texture, WrongCellsAreRefused) {
  EXPECT_THROW(Texture({0.0, 0.5, 0.5, 1.0}, {0.0, 1.0}, {1, 2, 3}), Error);
  EXPECT_THROW(Texture({0.0, 0.5}, {0.0, 1.0}, {1}), Error);
  EXPECT_THROW(Texture({0.0, 0.5, 1.0}, {0.0, 1.0}, {1}), Error);
  EXPECT_THROW(Texture({0.0, 0.5, 1.0}, {0.0, 1.0}, {1, 256}), Error);
}

TEST(Tag36h11, BitsAreTheCodesThatKalibrPrints) {
  // The first codes of the family in its first edition, read row by row from the upper left.
  const std::array<std::uint64_t, 5> codes{0xd5d628584, 0xd97f18b49, 0xdd280910e, 0xe479e9c98, 0xebcbca822};
  EXPECT_EQ(tag36h11_count(), 587);
  for (std::size_t id = 0; id < codes.size(); ++id) {
    const TagCells cells = tag36h11_cells(static_cast<int>(id));
    std::uint64_t code = 0;
    for (std::size_t r = 0; r < 10; ++r) {
      for (std::size_t c = 0; c < 10; ++c) {
        const bool is_border = r < 2 || r > 7 || c < 2 || c > 7;
        if (is_border) {
          EXPECT_FALSE(cells[r][c]);
        } else {
          code = 2 * code + cells[r][c];
        }
      }
    }
    EXPECT_EQ(code, codes[id]) << id;
  }
}

TEST(AprilGridTexture, HasSquaresAtTheCrossingsAndUprightTags) {
  const AprilGrid board{.cols = 3, .rows = 2, .tag_size_m = 0.1, .tag_spacing = 0.25};
  const Texture texture = aprilgrid_texture(board);
  const double width = 3 * 0.125 + 0.075, height = 2 * 0.125 + 0.075;
  const auto grey = [&](double x_t, double y_t) {  // m, frame t; the sheet starts two gaps before tag 0
    return texture.mean((x_t + 0.05) / width, (y_t + 0.05) / height, 1e-6, 1e-6);
  };
  EXPECT_EQ(grey(-0.0125, -0.0125), kInk);
  EXPECT_EQ(grey(-0.0125, 0.05), kPaper);
  EXPECT_EQ(grey(0.1125, 0.1125), kInk);
  EXPECT_EQ(grey(0.1125, 0.05), kPaper);
  EXPECT_EQ(grey(3 * 0.125 - 0.0125, 2 * 0.125 - 0.0125), kInk);
  EXPECT_EQ(grey(3 * 0.125 + 0.0125, 2 * 0.125 - 0.0125), kPaper);
  const TagCells cells = tag36h11_cells(4);  // second row, second column
  for (int r = 0; r < 10; ++r) {
    for (int c = 0; c < 10; ++c) {
      EXPECT_EQ(grey(0.125 + 0.01 * c + 0.005, 0.125 + 0.1 - 0.01 * r - 0.005),
                cells[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)] ? kPaper : kInk);
    }
  }
}

TEST(BoardTextures, PointsAreWhereTheScenesPutThem) {
  const Texture squares = checkerboard_texture({.cols = 4, .rows = 3, .col_spacing_m = 0.02, .row_spacing_m = 0.03});
  const auto square = [&](double x, double y) { return squares.mean((x + 2.0) / 7.0, (y + 2.0) / 6.0, 1e-6, 1e-6); };
  EXPECT_EQ(square(-0.5, -0.5), kInk);
  EXPECT_EQ(square(0.5, 0.5), kInk);
  EXPECT_EQ(square(0.5, -0.5), kPaper);
  EXPECT_EQ(square(-1.5, -0.5), kPaper);
  EXPECT_EQ(square(3.5, 2.5), kPaper);
  const CircleGrid circles{.cols = 3, .rows = 4, .spacing_m = 0.02, .radius_m = 0.005, .is_asymmetric = true};
  const Texture discs = circle_grid_texture(circles);
  const auto disc = [&](double x, double y) { return discs.mean((x + 1.0) / 7.0, (y + 1.0) / 5.0, 1e-6, 1e-6); };
  EXPECT_EQ(disc(5.0, 3.0), kInk);
  EXPECT_EQ(disc(5.0, 2.0), kPaper);
  EXPECT_EQ(disc(4.2, 2.0), kInk);
  EXPECT_EQ(disc(4.3, 2.0), kPaper);
  const double covered = 12.0 * 3.14159265 * 0.25 * 0.25 / 35.0;
  EXPECT_NEAR(discs.mean(0.5, 0.5, 0.5, 0.5), kPaper + covered * (kInk - kPaper), 0.05);
}

TEST(WallTexture, IsAFunctionOfSeedAndNameAndHasContrast) {
  const Texture a = wall_texture({3.0, 2.0}, 0.02, 5, "wall"), b = wall_texture({3.0, 2.0}, 0.02, 5, "wall");
  const Texture c = wall_texture({3.0, 2.0}, 0.02, 6, "wall");
  double sum = 0.0, squares = 0.0, other = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const double x = std::fmod(0.6180339887 * i, 1.0), y = (i + 0.5) / 1000.0;
    const double grey = a.mean(x, y, 1e-3, 1e-3);
    ASSERT_EQ(grey, b.mean(x, y, 1e-3, 1e-3));
    sum += grey / 1000.0;
    squares += grey * grey / 1000.0;
    other += std::abs(grey - c.mean(x, y, 1e-3, 1e-3)) / 1000.0;
  }
  EXPECT_NEAR(sum, 128.0, 20.0);
  EXPECT_GT(std::sqrt(squares - sum * sum), 20.0);
  EXPECT_GT(other, 20.0);
  EXPECT_THROW(wall_texture({3.0, 2.0}, 1e-4, 5, "wall"), Error);
}

}  // namespace
}  // namespace vispline

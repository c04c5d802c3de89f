/// What is printed on calibration boards; the sheet is that of the scenes in boards.h, margin included.
#pragma once

#include "vispline/simulate/boards.h"
#include "vispline/simulate/texture.h"

namespace vispline {

/// Grey of ink and of paper.
inline constexpr float kInk = 25.0f;
inline constexpr float kPaper = 225.0f;

/// Tags with a border of 2 cells, and black squares that fill the crossings of the gaps, as Kalibr draws them.
Texture aprilgrid_texture(const AprilGrid& board);
Texture checkerboard_texture(const Checkerboard& board);
/// Discs on a raster of 1/32 of the spacing, each cell as dark as the part of it that is covered. Throws
/// E-ARGUMENT for more than 16000 places.
Texture circle_grid_texture(const CircleGrid& board);

}  // namespace vispline

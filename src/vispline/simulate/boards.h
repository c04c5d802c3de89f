/// Calibration boards as scenes: the points that a detector finds, on a flat surface. Frame t of a board: x to the
/// right, y up, z out of the board towards the camera, the origin at point 0. docs/math/rendering.md, Boards.
#pragma once

#include "vispline/simulate/scene.h"

namespace vispline {

/// Kalibr's grid of tags of the family tag36h11; the tag in column c of row r, counted from the lower left, has the id
/// r * cols + c. Corner k of tag i, counter-clockwise from the lower left, is landmark 4 i + k.
struct AprilGrid {
  int cols = 6;
  int rows = 6;
  double tag_size_m = 0.088;  ///< edge of a tag, black border included
  double tag_spacing = 0.3;   ///< gap between tags / tag_size_m
};

/// Inner corners; corner c of row r is landmark r * cols + c. The square whose upper right corner is point 0 is black.
struct Checkerboard {
  int cols = 9;
  int rows = 6;
  double col_spacing_m = 0.04;  ///< width of a square
  double row_spacing_m = 0.04;
};

/// Black discs; disc c of row r is landmark r * cols + c. In an asymmetric grid (OpenCV's) the discs of a row are
/// 2 spacings apart, and those of odd rows are moved to the right by one.
struct CircleGrid {
  int cols = 7;
  int rows = 6;
  double spacing_m = 0.04;
  double radius_m = 0.01;
  bool is_asymmetric = false;
};

/// The board at T_w_t. Throws E-ARGUMENT for sizes that are not positive, and for an AprilGrid of more tags than the
/// family has, 587, or a circle grid of more than 16000 places.
Scene aprilgrid_scene(const AprilGrid& board, const Pose& T_w_t);
Scene checkerboard_scene(const Checkerboard& board, const Pose& T_w_t);
Scene circle_grid_scene(const CircleGrid& board, const Pose& T_w_t);

}  // namespace vispline

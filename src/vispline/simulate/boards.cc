#include "vispline/simulate/boards.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "vispline/core/error.h"
#include "vispline/simulate/board_textures.h"
#include "vispline/simulate/tag36h11.h"

namespace vispline {
namespace {

/// A sheet with its lower left corner at `corner_t`.
Surface sheet(const Pose& T_w_t, const Vector2d& corner_t, const Vector2d& size_m, Texture print) {
  return {.T_w_s = T_w_t * Pose{Matrix3d::Identity(), {corner_t.x(), corner_t.y(), 0.0}},
          .size_m = size_m,
          .texture = std::make_shared<const Texture>(std::move(print))};
}

void add_point(Scene& scene, const Pose& T_w_t, double x, double y) {
  scene.landmarks.push_back(
      {.id = scene.landmarks.size(), .point_w = T_w_t * Vector3d(x, y, 0.0), .normal_w = T_w_t.R.col(2)});
}

}  // namespace

Scene aprilgrid_scene(const AprilGrid& board, const Pose& T_w_t) {
  const int tags = tag36h11_count();
  require(board.cols > 0 && board.rows > 0 && board.cols <= tags && board.rows <= tags / board.cols,
          "an AprilGrid of 1 to " + std::to_string(tags) + " tags");
  require(board.tag_size_m > 0.0 && board.tag_spacing > 0.0, "an AprilGrid whose tags and gaps have a size");
  const double size = board.tag_size_m, gap = size * board.tag_spacing, pitch = size + gap;
  Scene scene;
  for (int r = 0; r < board.rows; ++r) {
    for (int c = 0; c < board.cols; ++c) {
      const double x = c * pitch, y = r * pitch;
      add_point(scene, T_w_t, x, y);
      add_point(scene, T_w_t, x + size, y);
      add_point(scene, T_w_t, x + size, y + size);
      add_point(scene, T_w_t, x, y + size);
    }
  }
  const Vector2d margin = Vector2d::Constant(2.0 * gap);
  scene.surfaces.push_back(sheet(T_w_t, -margin,
                                 Vector2d(board.cols * pitch - gap, board.rows * pitch - gap) + 2.0 * margin,
                                 aprilgrid_texture(board)));
  return scene;
}

Scene checkerboard_scene(const Checkerboard& board, const Pose& T_w_t) {
  require(board.cols > 0 && board.rows > 0, "a checkerboard with inner corners");
  require(board.col_spacing_m > 0.0 && board.row_spacing_m > 0.0, "a checkerboard whose squares have a size");
  Scene scene;
  for (int r = 0; r < board.rows; ++r) {
    for (int c = 0; c < board.cols; ++c) add_point(scene, T_w_t, c * board.col_spacing_m, r * board.row_spacing_m);
  }
  const Vector2d square(board.col_spacing_m, board.row_spacing_m);
  scene.surfaces.push_back(sheet(T_w_t, -2.0 * square, square.cwiseProduct(Vector2d(board.cols + 3, board.rows + 3)),
                                 checkerboard_texture(board)));
  return scene;
}

Scene circle_grid_scene(const CircleGrid& board, const Pose& T_w_t) {
  require(board.cols > 0 && board.rows > 0, "a grid with circles");
  require(board.spacing_m > 0.0 && board.radius_m > 0.0 && board.radius_m < 0.5 * board.spacing_m,
          "circles with a radius below half their spacing");
  Scene scene;
  double right = 0.0;
  for (int r = 0; r < board.rows; ++r) {
    for (int c = 0; c < board.cols; ++c) {
      const double x = board.spacing_m * (board.is_asymmetric ? 2 * c + r % 2 : c);
      right = std::max(right, x);
      add_point(scene, T_w_t, x, r * board.spacing_m);
    }
  }
  const Vector2d margin = Vector2d::Constant(board.spacing_m);
  scene.surfaces.push_back(sheet(T_w_t, -margin, Vector2d(right, (board.rows - 1) * board.spacing_m) + 2.0 * margin,
                                 circle_grid_texture(board)));
  return scene;
}

}  // namespace vispline

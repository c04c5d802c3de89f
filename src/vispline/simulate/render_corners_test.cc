// Where things are in rendered images, against projections by bisection.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "vispline/simulate/boards.h"
#include "vispline/simulate/render_testing.h"
#include "vispline/simulate/tag36h11.h"

namespace vispline {
namespace {

/// Pixel at which the shutter sees the point, by bisection over the line.
Vector2d shutter_pixel(const Camera& camera, const Turn& turn, const Vector3d& point_w) {
  const auto seen = [&](double line) {
    const double delay_s = camera.time_offset_s + camera.shutter.line_delay_s * line;
    const Pose T_w_c = turn.at(kStamp + from_seconds(delay_s)).T_w_b() * camera.T_c_b.inverse();
    return camera.lens.project(T_w_c.inverse() * point_w).value();
  };
  double low = -500.0, high = 1000.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (seen(middle).y() > middle ? low : high) = middle;
  }
  return seen(low);
}

/// Light at a pixel, blurred by (1 4 6 4 1) / 16 in both directions: an edge between pixels then has no steps.
double soft(const GreyImage& image, int x, int y) {
  constexpr std::array<double, 5> kWeights{1.0 / 16, 4.0 / 16, 6.0 / 16, 4.0 / 16, 1.0 / 16};
  double sum = 0.0;
  for (int i = 0; i < 25; ++i) {
    sum += kWeights[static_cast<std::size_t>(i / 5)] * kWeights[static_cast<std::size_t>(i % 5)] *
           image.at(x + i % 5 - 2, y + i / 5 - 2);
  }
  return sum;
}

/// The saddle at which two dark and two bright squares meet: gradients of the window are normal to the way to it.
Vector2d refined_corner(const GreyImage& image, Vector2d px) {
  for (int iteration = 0; iteration < 10; ++iteration) {
    Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
    Vector2d b = Vector2d::Zero();
    const int cx = static_cast<int>(std::lround(px.x())), cy = static_cast<int>(std::lround(px.y()));
    for (int y = cy - 5; y <= cy + 5; ++y) {
      for (int x = cx - 5; x <= cx + 5; ++x) {
        const Vector2d at(x, y);
        const Vector2d gradient(soft(image, x + 1, y) - soft(image, x - 1, y),
                                soft(image, x, y + 1) - soft(image, x, y - 1));
        const double weight = std::exp(-(at - px).squaredNorm() / 8.0);
        A += weight * gradient * gradient.transpose();
        b += weight * gradient * gradient.dot(at);
      }
    }
    px = A.inverse() * b;
  }
  return px;
}

/// Worst distance of the corners of a board from where they must be.
struct CornerErrors {
  double worst_px = 0.0;
  int corners = 0;
};

CornerErrors corner_errors(const Scene& board, const Camera& camera, const Turn& turn) {
  const GreyImage image = picture(board, camera, turn, kNoiseless);
  CornerErrors errors;
  for (const SceneLandmark& landmark : board.landmarks) {
    const Vector2d expected = shutter_pixel(camera, turn, landmark.point_w);
    if (expected.minCoeff() < 12 || expected.x() > 627 || expected.y() > 467) continue;
    errors.worst_px = std::max(errors.worst_px, (refined_corner(image, expected) - expected).norm());
    ++errors.corners;
  }
  return errors;
}

TEST(RenderCorners, LieWhereTheRollingShutterSeesThem) {
  const Scene board = checkerboard_scene({.cols = 8, .rows = 6, .col_spacing_m = 0.08, .row_spacing_m = 0.08},
                                         upright(-0.25, 1.0, -0.2));
  for (const Turn& turn : {Turn{}, Turn{.rate = {0.4, 0.9, 1.2}, .v_w = {0.5, -0.3, 0.4}}}) {
    const CornerErrors errors = corner_errors(board, camera_forward(), turn);
    EXPECT_GT(errors.corners, 40);
    EXPECT_LT(errors.worst_px, 0.06);
  }
}

TEST(RenderCorners, OfAnAprilGridLieWhereAFisheyeSeesThem) {
  Camera camera = camera_forward();
  camera.lens = {LensModel::kPinholeEquidistant,
                 (LensParams(8) << 300.3, 299.1, 322.7, 238.2, -0.01, 0.02, -0.008, 0.002).finished()};
  camera.time_offset_s = 0.004;
  const Scene board = aprilgrid_scene({}, upright(-0.3, 0.6, -0.3));
  const CornerErrors errors = corner_errors(board, camera, {.rate = {-0.3, 0.8, 0.9}, .v_w = {0.2, 0.1, -0.3}});
  EXPECT_GT(errors.corners, 100);
  EXPECT_LT(errors.worst_px, 0.06);
}

TEST(RenderCorners, EveryBitOfEveryTagCanBeRead) {
  const AprilGrid grid{};
  const Pose T_w_t = upright(-0.3, 0.8, -0.3);
  const Camera camera = camera_forward();
  const Turn turn{.rate = {0.2, 0.5, 1.5}};
  const GreyImage image = picture(aprilgrid_scene(grid, T_w_t), camera, turn, kNoiseless);
  for (int tag = 0; tag < grid.cols * grid.rows; ++tag) {
    const TagCells cells = tag36h11_cells(tag);
    const double pitch = grid.tag_size_m * (1.0 + grid.tag_spacing), cell = grid.tag_size_m / kTagCells;
    const Vector3d corner_t(tag % grid.cols * pitch, tag / grid.cols * pitch + grid.tag_size_m, 0.0);
    for (int i = 0; i < kTagCells * kTagCells; ++i) {
      const int r = i / kTagCells, c = i % kTagCells;
      const Vector3d middle_t = corner_t + cell * Vector3d(c + 0.5, -r - 0.5, 0.0);
      const Vector2d px = shutter_pixel(camera, turn, T_w_t * middle_t);
      const int grey = image.at(static_cast<int>(std::lround(px.x())), static_cast<int>(std::lround(px.y())));
      ASSERT_EQ(grey > 125, cells[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)])
          << tag << " " << r << " " << c;
    }
  }
}

}  // namespace
}  // namespace vispline

#include "vispline/simulate/render.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>

#include "vispline/core/error.h"
#include "vispline/core/so3.h"
#include "vispline/simulate/board_textures.h"
#include "vispline/simulate/boards.h"
#include "vispline/simulate/box_room.h"
#include "vispline/simulate/tag36h11.h"
#include "vispline/simulate/texture.h"

namespace vispline {
namespace {

constexpr double kDelay_s = 30e-3 / 480;
const Time kStamp = time_from_ns(1'000'000'000);

/// A body that turns about a fixed axis by rate t + acceleration t^2 / 2 and flies straight on; t = 0 in the middle of
/// the readout of a frame with kDelay_s.
struct Turn {
  Vector3d rate = Vector3d::Zero(), acceleration = Vector3d::Zero(), v_w = Vector3d::Zero();
  TimeSpan span() const { return {kStamp - std::chrono::seconds(1), kStamp + std::chrono::seconds(1)}; }
  BodyState at(Time time) const {
    const double t = to_seconds(time - kStamp) - 240 * kDelay_s;
    BodyState body;
    body.R_w_b = SO3::exp<double>(rate * t + 0.5 * t * t * acceleration);
    body.omega_b = rate + t * acceleration;
    body.p_w = t * v_w;
    body.v_w = v_w;
    return body;
  }
};

/// Body: x right, y forward, z up, as the world.
Camera camera_forward() {
  Camera camera;
  camera.T_c_b.R << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  camera.shutter.line_delay_s = kDelay_s;
  return camera;
}

/// A board that stands upright, point 0 at (x, y, z).
Pose upright(double x, double y, double z) {
  Pose T_w_t;
  T_w_t.R << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  T_w_t.p = {x, y, z};
  return T_w_t;
}

constexpr RenderOptions kNoiseless{.read_sigma_grey = 0.0};
constexpr RenderOptions kFine{.supersampling = 8, .read_sigma_grey = 0.0};  // rims of boards fall between few rays

GreyImage picture(const Scene& scene, const Camera& camera, const Turn& turn, const RenderOptions& options) {
  return Renderer(scene, camera, options).render(Trajectory(turn), kStamp).value();
}

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

TEST(Render, CornersLieWhereTheRollingShutterSeesThem) {
  const Scene board = checkerboard_scene({.cols = 8, .rows = 6, .col_spacing_m = 0.08, .row_spacing_m = 0.08},
                                         upright(-0.25, 1.0, -0.2));
  for (const Turn& turn : {Turn{}, Turn{.rate = {0.4, 0.9, 1.2}, .v_w = {0.5, -0.3, 0.4}}}) {
    const CornerErrors errors = corner_errors(board, camera_forward(), turn);
    EXPECT_GT(errors.corners, 40);
    EXPECT_LT(errors.worst_px, 0.06);
  }
}

TEST(Render, CornersOfAnAprilGridLieWhereAFisheyeSeesThem) {
  Camera camera = camera_forward();
  camera.lens = {LensModel::kPinholeEquidistant,
                 (LensParams(8) << 300.3, 299.1, 322.7, 238.2, -0.01, 0.02, -0.008, 0.002).finished()};
  camera.time_offset_s = 0.004;
  const Scene board = aprilgrid_scene({}, upright(-0.3, 0.6, -0.3));
  const CornerErrors errors = corner_errors(board, camera, {.rate = {-0.3, 0.8, 0.9}, .v_w = {0.2, 0.1, -0.3}});
  EXPECT_GT(errors.corners, 100);
  EXPECT_LT(errors.worst_px, 0.06);
}

TEST(Render, EveryBitOfEveryTagCanBeRead) {
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

/// A white board left of x = 0 before a black one: one straight vertical edge through the middle of the image.
class Edge : public ::testing::Test {
 protected:
  Edge() {
    const auto plain = [](float grey) {
      return std::make_shared<const Texture>(Texture({0.0, 1.0}, {0.0, 1.0}, {grey}));
    };
    scene_.surfaces.push_back({.T_w_s = upright(-4.0, 2.0, -3.0), .size_m = {4.0, 6.0}, .texture = plain(200.0f)});
    scene_.surfaces.push_back({.T_w_s = upright(-4.0, 2.1, -3.0), .size_m = {8.0, 6.0}, .texture = plain(40.0f)});
  }
  /// Column of the edge in a row: so many pixels are white, the one it falls in by its part.
  static double column(const GreyImage& image, int row) {
    double white = 0.0;
    for (int x = 0; x < image.width; ++x) white += (image.at(x, row) - 40.0) / 160.0;
    return white - 0.5;
  }
  Scene scene_;
};

TEST_F(Edge, BendsByThePredictedNumberOfPixels) {
  const Turn turn{.rate = {0.0, 0.0, 1.0}, .acceleration = {0.0, 0.0, 200.0}};
  const GreyImage image = picture(scene_, camera_forward(), turn, kFine);
  const auto predicted = [&](int row) {
    const double t = (row - 240) * kDelay_s, yaw = t + 100.0 * t * t;
    return 320.0 + 460.0 * std::tan(yaw);  // a turn to the left moves the edge to the right
  };
  for (int row = 0; row < 480; row += 7) ASSERT_NEAR(column(image, row), predicted(row), 0.1) << row;
  const double bend = 0.5 * (column(image, 10) + column(image, 470)) - column(image, 240);
  EXPECT_NEAR(bend, 460.0 * 100.0 * std::pow(230 * kDelay_s, 2), 0.3);
  EXPECT_GT(bend, 9.0);
}

TEST_F(Edge, IsStraightForAGlobalShutterAndShearsTheOtherWayForAnUpwardReading) {
  const Turn turn{.rate = {0.0, 0.0, 1.0}};
  Camera camera = camera_forward();
  const auto shear = [&] {
    const GreyImage image = picture(scene_, camera, turn, kFine);
    return column(image, 479) - column(image, 0);
  };
  EXPECT_NEAR(shear(), 460.0 * 479 * kDelay_s, 0.2);
  camera.shutter.direction = ReadoutDirection::kUp;
  EXPECT_NEAR(shear(), -460.0 * 479 * kDelay_s, 0.2);
  camera.rate_hz = 20.0;
  camera.shutter.direction = ReadoutDirection::kRight;  // all of the vertical edge is read at one time
  EXPECT_NEAR(shear(), 0.0, 0.1);
  camera.shutter = {};
  EXPECT_NEAR(shear(), 0.0, 0.1);
}

TEST_F(Edge, IsBlurredAroundTheMiddleOfTheExposure) {
  const Turn turn{.rate = {0.0, 0.0, 2.0}};
  Camera camera = camera_forward();
  const GreyImage sharp = picture(scene_, camera, turn, kFine);
  camera.shutter.exposure_s = 0.01;
  const GreyImage blurred = picture(scene_, camera, turn, kFine);
  int grey = 0;
  for (int x = 0; x < 640; ++x) grey += blurred.at(x, 240) > 45 && blurred.at(x, 240) < 195;
  EXPECT_NEAR(grey, 460.0 * 2.0 * 0.01, 1.5);
  for (const int row : {60, 240, 400}) EXPECT_NEAR(column(blurred, row), column(sharp, row), 0.15) << row;
}

TEST(Render, AGlobalShutterIsTheLimit) {
  const Scene room = box_room({.cell_m = 0.04});
  Camera camera = camera_forward();
  camera.shutter.line_delay_s = 1e-13;
  const Turn turn{.rate = {0.3, 0.2, 0.5}, .v_w = {0.1, 0.2, 0.3}};
  const GreyImage limit = picture(room, camera, turn, {});
  camera.shutter.line_delay_s = 0.0;
  EXPECT_EQ(limit.grey, picture(room, camera, turn, {}).grey);
}

TEST(Render, SameBytesForAnyThreads) {
  Scene room = box_room({.cell_m = 0.04});
  add_scene(room, aprilgrid_scene({}, upright(-0.3, 0.8, -0.3)));
  Camera camera = camera_forward();
  camera.resolution_px = {321, 243};
  camera.shutter.exposure_s = 0.004;
  RenderOptions options{.vignette = 0.3, .read_sigma_grey = 2.0, .seed = 7};
  const Turn turn{.rate = {0.3, 0.2, 0.5}};
  const GreyImage one = picture(room, camera, turn, options);
  for (const std::size_t threads : {2, 4}) {
    options.threads = threads;
    EXPECT_EQ(picture(room, camera, turn, options).grey, one.grey) << threads;
  }
  options.seed = 8;
  EXPECT_NE(picture(room, camera, turn, options).grey, one.grey);
}

TEST(Render, LightFallsToTheCornersAndNoiseIsAsWideAsAsked) {
  Scene white;
  white.surfaces.push_back({.T_w_s = upright(-5.0, 1.0, -5.0), .size_m = {10.0, 10.0}});  // plain grey, 128
  const RenderOptions options{.gain = 1.25, .vignette = 0.4, .read_sigma_grey = 0.0};
  const GreyImage quiet = picture(white, camera_forward(), {}, options);
  EXPECT_EQ(quiet.at(320, 240), 160);
  EXPECT_EQ(quiet.at(0, 0), 96);
  EXPECT_EQ(quiet.at(639, 479), 96);
  const GreyImage noisy = picture(white, camera_forward(), {}, {.gain = 1.25, .read_sigma_grey = 4.0});
  double sum = 0.0, squares = 0.0;
  for (const std::uint8_t grey : noisy.grey) {
    sum += grey - 160.0;
    squares += (grey - 160.0) * (grey - 160.0);
  }
  const double n = 640.0 * 480.0, variance = 25.0 + 1.0 / 12.0;  // of the noise, and of rounding
  EXPECT_NEAR(sum / n, 0.0, 5.0 * std::sqrt(variance / n));
  EXPECT_NEAR(squares / n / variance, 1.0, 5.0 * std::sqrt(2.0 / n));
}

TEST(Render, IsEmptyWhereTheTrajectoryEndsDuringTheReadout) {
  Camera camera = camera_forward();
  camera.shutter.exposure_s = 0.002;
  const Renderer renderer({}, camera, {});
  const Trajectory trajectory{Turn{}};
  const Time end = trajectory.span().end;
  const Duration readout = from_seconds(479 * kDelay_s);
  EXPECT_EQ(renderer.exposed(kStamp).begin, kStamp - std::chrono::milliseconds(1));
  EXPECT_EQ(renderer.exposed(kStamp).end, kStamp + readout + std::chrono::milliseconds(1));
  EXPECT_TRUE(renderer.render(trajectory, end - readout - std::chrono::milliseconds(1)));
  EXPECT_FALSE(renderer.render(trajectory, end - readout));
}

TEST(Render, WrongOptionsAreRefused) {
  for (const RenderOptions& wrong : {RenderOptions{.supersampling = 0}, RenderOptions{.most_exposures = 0},
                                     RenderOptions{.gain = NAN}, RenderOptions{.vignette = 1.5},
                                     RenderOptions{.read_sigma_grey = -1.0}, RenderOptions{.background_grey = 300.0}}) {
    EXPECT_THROW(Renderer({}, Camera{}, wrong), Error);
  }
}

}  // namespace
}  // namespace vispline

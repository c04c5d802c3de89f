#include "vispline/simulate/render.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "vispline/core/error.h"
#include "vispline/simulate/boards.h"
#include "vispline/simulate/box_room.h"
#include "vispline/simulate/render_testing.h"
#include "vispline/simulate/texture.h"

namespace vispline {
namespace {

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

#include "vispline/sensors/camera.h"

#include <gtest/gtest.h>

#include <functional>

#include "vispline/core/error.h"
#include "vispline/sensors/lens_testing.h"
#include "vispline/sensors/rig.h"

namespace vispline::testing {
namespace {

TEST(Shutter, LinesInTheOrderOfReading) {
  const std::array<int, 2> size{640, 480};
  const Vector2d px(100.25, 30.5);
  const auto expect = [&](ReadoutDirection direction, double line, int lines) {
    const Shutter shutter{.line_delay_s = 1e-5, .direction = direction};
    EXPECT_DOUBLE_EQ(shutter.line(px, size), line);
    EXPECT_EQ(shutter.lines(size), lines);
    const Vector2d step(0.5, -0.25);
    EXPECT_DOUBLE_EQ(shutter.line(px + step, size) - line, shutter.line_gradient().dot(step));
  };
  expect(ReadoutDirection::kDown, 30.5, 480);
  expect(ReadoutDirection::kUp, 448.5, 480);
  expect(ReadoutDirection::kRight, 100.25, 640);
  expect(ReadoutDirection::kLeft, 538.75, 640);
}

TEST(Camera, DelayOfAPixelAndBoundsOfTheImage) {
  Camera camera;
  camera.time_offset_s = -0.004;
  camera.shutter.line_delay_s = 3e-5;
  EXPECT_DOUBLE_EQ(camera.delay_s({10.0, 100.0}), -0.001);
  EXPECT_TRUE(camera.in_image({-0.5, 479.5}));
  EXPECT_FALSE(camera.in_image({-0.51, 0.0}));
  EXPECT_FALSE(camera.in_image({0.0, 479.51}));
  EXPECT_FALSE(camera.in_image({std::nan(""), 0.0}));
}

/// The message of the error that the changed camera makes.
std::string refusal(const std::function<void(Camera&)>& change) {
  Camera camera;
  camera.name = "left";
  camera.lens = typical_lens(LensModel::kDoubleSphere);
  change(camera);
  try {
    require_valid(camera);
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::kUsage);
    EXPECT_EQ(error.diagnostic().code, "E-CONFIG");
    return error.diagnostic().message;
  }
  return "accepted";
}

TEST(Camera, WhatIsWrongIsNamed) {
  const double nan = std::nan("");
  EXPECT_EQ(refusal([](Camera&) {}), "accepted");
  EXPECT_EQ(refusal([](Camera& c) { c.name.clear(); }), "camera '': name must be not empty");
  EXPECT_EQ(refusal([](Camera& c) { c.rate_hz = 0.0; }), "camera 'left': rate_hz must be finite and positive");
  EXPECT_EQ(refusal([](Camera& c) { c.resolution_px = {0, 480}; }), "camera 'left': resolution_px must be positive");
  EXPECT_EQ(refusal([](Camera& c) { c.lens.params.conservativeResize(5); }),
            "camera 'left': lens must be ds with 6 parameters");
  EXPECT_EQ(refusal([&](Camera& c) { c.lens.params[4] = nan; }), "camera 'left': pu must be finite");
  EXPECT_EQ(refusal([](Camera& c) { c.lens.params[2] = -160.0; }), "camera 'left': fu must be positive");
  EXPECT_EQ(refusal([](Camera& c) { c.lens.params[1] = 1.01; }), "camera 'left': alpha must be between 0 and 1");
  EXPECT_EQ(refusal([&](Camera& c) { c.T_c_b.p.x() = nan; }), "camera 'left': T_c_b must be finite");
  EXPECT_EQ(refusal([](Camera& c) { c.T_c_b.R *= 1.01; }),
            "camera 'left': the rotation of T_c_b must be orthonormal and right-handed");
  EXPECT_EQ(refusal([](Camera& c) { c.T_c_b.R *= -1.0; }),
            "camera 'left': the rotation of T_c_b must be orthonormal and right-handed");
  EXPECT_EQ(refusal([&](Camera& c) { c.time_offset_s = nan; }), "camera 'left': time_offset must be finite");
  EXPECT_EQ(refusal([](Camera& c) { c.shutter.line_delay_s = -1e-5; }),
            "camera 'left': line_delay must be finite and not negative");
  EXPECT_EQ(refusal([](Camera& c) { c.shutter.line_delay_s = 1e-4; }),
            "camera 'left': line_delay must be short enough to read the image before the next one begins");
  EXPECT_EQ(refusal([](Camera& c) { c.shutter.exposure_s = -1.0; }),
            "camera 'left': exposure must be finite and not negative");
  EXPECT_EQ(refusal([](Camera& c) { c.pixel_sigma_px = -1.0; }),
            "camera 'left': pixel_sigma_px must be finite and not negative");
}

TEST(Rig, NamesAreUniqueOverAllSensors) {
  Rig rig;
  rig.imus.resize(1);
  rig.cameras.resize(2);
  rig.cameras[1].name = "cam1";
  EXPECT_NO_THROW(require_valid(rig));
  EXPECT_EQ(find_camera(rig, "cam1"), &rig.cameras[1]);
  EXPECT_EQ(find_camera(rig, "imu0"), nullptr);
  EXPECT_EQ(find_imu(rig, "imu0"), rig.imus.data());
  rig.cameras[1].name = "cam0";
  EXPECT_THROW(require_valid(rig), Error);
  rig.cameras[1].name = "imu0";
  EXPECT_THROW(require_valid(rig), Error);
  rig.cameras[1].name = "cam1";
  rig.cameras[0].rate_hz = -1.0;
  EXPECT_THROW(require_valid(rig), Error);
}

}  // namespace
}  // namespace vispline::testing

#include "vispline/sensors/rolling_shutter.h"

#include <gtest/gtest.h>

#include "vispline/core/error.h"
#include "vispline/core/se3.h"
#include "vispline/sensors/lens_testing.h"

namespace vispline::testing {
namespace {

/// A body that turns and moves with constant rates in its own frame: T_w_b(t) = T_w_b(0) exp(t twist).
struct Screw {
  Pose start{};
  Vector6d twist = Vector6d::Zero();

  std::optional<BodyState> operator()(double t) const {
    const Pose T_w_b = start * SE3::exp<double>(Vector6d(t * twist));
    BodyState state;
    state.R_w_b = T_w_b.R;
    state.p_w = T_w_b.p;
    state.v_w = T_w_b.R * twist.head<3>();
    state.omega_b = twist.tail<3>();
    return state;
  }
};

/// 480 lines in 30 ms, f = 460 px.
Camera phone() {
  Camera camera;
  camera.lens = make_lens(LensModel::kPinhole, {460.0, 460.0, 319.5, 239.5});
  camera.shutter.line_delay_s = 0.030 / 480.0;
  return camera;
}

Camera generic_camera(LensModel model, ReadoutDirection direction, std::uint64_t seed) {
  Draw draw(seed);
  Camera camera = phone();
  camera.lens = generic_lens(model, seed);
  camera.resolution_px = {752, 480};
  camera.shutter.direction = direction;
  camera.T_c_b = SE3::exp<double>(draw.vector<6>(0.4));
  camera.time_offset_s = 0.01 * draw();
  return camera;
}

/// A point that the camera sees near `px` at the stamp, `depth` away.
HomogeneousPoint point_near(const Camera& camera, const Pose& T_w_b, const Vector2d& px, double inverse_distance) {
  const InverseDepthLandmark landmark{camera.lens.unproject(px).value(), inverse_distance};
  return landmark.in_world(T_w_b * camera.T_c_b.inverse());
}

/// The image at an instant, by the formula of a global shutter.
Vector2d image_at(const Camera& camera, const Screw& body, const HomogeneousPoint& point, double delay_s) {
  return camera.lens.project(point.seen_from(body(delay_s)->T_w_b() * camera.T_c_b.inverse())).value();
}

/// The line by bisection of line(px(t)) - line(t), which needs no derivative; the pixel at it.
Vector2d by_bisection(const Camera& camera, const Screw& body, const HomogeneousPoint& point) {
  double low = -0.5, high = camera.shutter.lines(camera.resolution_px) - 0.5;
  const auto image = [&](double line) {
    return image_at(camera, body, point, camera.time_offset_s + camera.shutter.line_delay_s * line);
  };
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (camera.shutter.line(image(middle), camera.resolution_px) > middle ? low : high) = middle;
  }
  return image(0.5 * (low + high));
}

LineProjection project(const Camera& camera, const Screw& body, const HomogeneousPoint& point, LineMethod method) {
  return project_rolling_shutter(camera, point, body, {.method = method});
}

class RollingShutterLens : public ::testing::TestWithParam<LensModel> {};

TEST_P(RollingShutterLens, EveryMethodFindsWhatBisectionFinds) {
  int seen = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const auto direction = static_cast<ReadoutDirection>(seed % 4);
    const Camera camera = generic_camera(GetParam(), direction, seed);
    Draw draw(seed + 500);
    const Screw body{SE3::exp<double>(draw.vector<6>(2.0)), draw.vector<6>(2.0)};
    const Vector2d centre(375.5 + 250.0 * draw(), 239.5 + 150.0 * draw());
    if (!camera.lens.unproject(centre)) continue;
    const double inverse_distance = seed % 5 == 0 ? 0.0 : 0.6 + 0.4 * draw();
    const HomogeneousPoint point = point_near(camera, body.start, centre, inverse_distance);
    const LineProjection newton = project(camera, body, point, LineMethod::kNewton);
    ASSERT_EQ(newton.status, LineStatus::kConverged);
    ++seen;
    EXPECT_LE((newton.px - by_bisection(camera, body, point)).norm(), 1e-9);
    EXPECT_LE(std::abs(newton.line_error), 1e-10);
    EXPECT_LE(newton.iterations, 6);
    for (const LineMethod method : {LineMethod::kFirstOrder, LineMethod::kFixedPoint}) {
      const LineProjection other = project(camera, body, point, method);
      ASSERT_EQ(other.status, LineStatus::kConverged);
      EXPECT_LE((other.px - newton.px).norm(), 1e-6);
      EXPECT_LE(std::abs(other.delay_s - newton.delay_s), 1e-10);
    }
    const double line = camera.shutter.line(newton.px, camera.resolution_px);
    const auto observed =
        project_rolling_shutter(camera, point, body, {.method = LineMethod::kStatic, .start_line = line});
    EXPECT_LE((observed.px - newton.px).norm(), 1e-8);
    EXPECT_EQ(observed.iterations, 1);
  }
  EXPECT_GT(seen, 150);
}

TEST_P(RollingShutterLens, RateIsTheDerivativeOfThePixel) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Camera camera = generic_camera(GetParam(), ReadoutDirection::kDown, seed);
    Draw draw(seed + 900);
    const Screw body{SE3::exp<double>(draw.vector<6>(2.0)), draw.vector<6>(2.0)};
    const HomogeneousPoint point = point_near(camera, body.start, {300.0, 200.0}, seed % 5 == 0 ? 0.0 : 0.5);
    const MovingPixel pixel = project_moving(camera, *body(0.0), point).value();
    const auto slope = [&](double h) -> Vector2d {
      return (image_at(camera, body, point, h) - image_at(camera, body, point, -h)) / (2.0 * h);
    };
    const Vector2d expected = (4.0 * slope(5e-4) - slope(1e-3)) / 3.0;
    EXPECT_LE((pixel.rate_px_per_s - expected).norm(), 1e-7 * expected.norm());
  }
}

INSTANTIATE_TEST_SUITE_P(Models, RollingShutterLens, ::testing::ValuesIn(kLensModels), [](const auto& test) {
  std::string name(lens_name(test.param));
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(RollingShutter, GlobalShutterIsTheLimit) {
  Camera camera = phone();
  const Screw body{SE3::exp<double>(Vector6d::Constant(0.3)),
                   (Vector6d() << 1.0, -2.0, 0.5, 1.5, 2.0, -1.0).finished()};
  const HomogeneousPoint point = point_near(camera, body.start, {200.0, 300.0}, 0.4);
  const Vector2d global_px = image_at(camera, body, point, 0.0);
  double previous = 0.0;
  for (const double line_delay_s : {1e-5, 1e-6, 1e-7}) {
    camera.shutter.line_delay_s = line_delay_s;
    const double distance = (project(camera, body, point, LineMethod::kNewton).px - global_px).norm();
    if (previous > 0.0) {
      EXPECT_NEAR(previous / distance, 10.0, 0.5);
    }
    previous = distance;
  }
  camera.shutter.line_delay_s = 0.0;
  for (const auto method : {LineMethod::kNewton, LineMethod::kFirstOrder, LineMethod::kFixedPoint}) {
    const LineProjection sight = project(camera, body, point, method);
    EXPECT_EQ(sight.status, LineStatus::kConverged);
    EXPECT_LE((sight.px - global_px).norm(), 1e-12);
    EXPECT_EQ(sight.iterations, 1);
  }
}

/// Worst of 60 points, depth 1 to 6 m; bench/camera_bench.cc prints the whole table.
struct Effort {
  double motion = 0.0;  ///< |l d line / dt|
  int newton = 0;       ///< images to 1e-6 px from the exact one
  int first_order = 0;
  int fixed_point = 0;
};

int images_to_a_millionth(const Camera& camera, const Screw& body, const HomogeneousPoint& point, LineMethod method,
                          const Vector2d& exact_px) {
  for (int n = 1; n <= 60; ++n) {
    const LineSearch search{.method = method, .tolerance_lines = 0.0, .max_iterations = n};
    if ((project_rolling_shutter(camera, point, body, search).px - exact_px).norm() <= 1e-6) return n;
  }
  return 61;
}

Effort effort(double omega, double speed) {
  const Camera camera = phone();
  Effort worst;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Draw draw(seed);
    Screw body;
    body.twist << speed * draw.vector<3>(1.0).normalized(), omega * draw.vector<3>(1.0).normalized();
    const Vector2d px(319.5 + 220.0 * draw(), 239.5 + 160.0 * draw());
    const HomogeneousPoint point = point_near(camera, body.start, px, 1.0 / (3.5 + 2.5 * draw()));
    const LineProjection exact = project(camera, body, point, LineMethod::kNewton);
    if (exact.status != LineStatus::kConverged) continue;
    worst.motion = std::max(worst.motion, std::abs(camera.shutter.line_delay_s * exact.rate_px_per_s.y()));
    const auto count = [&](int& most, LineMethod method) {
      most = std::max(most, images_to_a_millionth(camera, body, point, method, exact.px));
    };
    count(worst.newton, LineMethod::kNewton);
    count(worst.first_order, LineMethod::kFirstOrder);
    count(worst.fixed_point, LineMethod::kFixedPoint);
  }
  return worst;
}

TEST(RollingShutter, StepsAgainstSpeed) {
  const Effort slow = effort(1.0, 0.5), fast = effort(6.0, 3.0), faster = effort(10.0, 3.0);
  EXPECT_NEAR(slow.motion, 0.04, 0.015);
  EXPECT_NEAR(fast.motion, 0.24, 0.06);
  EXPECT_LE(slow.newton, 1 + 2);  // an image at the start, then one for each step
  EXPECT_LE(fast.newton, 1 + 3);
  EXPECT_LE(faster.newton, 1 + 3);
  EXPECT_LE(faster.first_order, faster.newton + 1);
  EXPECT_GT(fast.fixed_point, 1 + 8);
  EXPECT_GT(faster.fixed_point, 1 + 12);
}

TEST(RollingShutter, WhatIsNotSeenSaysWhy) {
  const Camera camera = phone();
  const Screw still{};
  const auto status = [&](const Screw& body, const Vector3d& point_w) {
    return project(camera, body, HomogeneousPoint::known(point_w), LineMethod::kNewton).status;
  };
  EXPECT_EQ(status(still, {0.0, 0.0, 2.0}), LineStatus::kConverged);
  EXPECT_EQ(status(still, {0.0, 0.0, -2.0}), LineStatus::kBehindCamera);
  EXPECT_EQ(status(still, {0.0, 1.1, 2.0}), LineStatus::kOutOfImage);
  EXPECT_EQ(status(still, {0.0, -1.1, 2.0}), LineStatus::kOutOfImage);
  EXPECT_EQ(status(still, {1.5, 0.0, 2.0}), LineStatus::kOutOfImage);
  const auto nowhere = [](double) { return std::optional<BodyState>(); };
  EXPECT_EQ(project_rolling_shutter(camera, HomogeneousPoint::known({0.0, 0.0, 2.0}), nowhere).status,
            LineStatus::kOutsideCurve);
  EXPECT_THROW(project_rolling_shutter(camera, {}, still, {.method = LineMethod::kStatic}), Error);
}

TEST(RollingShutter, PitchAtWhichThePointMovesWithTheReadout) {
  // At the centre a pitch by omega moves the point at f omega px/s: one line per line at 1 / (f l) = 34.8 rad/s.
  const Camera camera = phone();
  const HomogeneousPoint far{Vector3d::UnitZ(), 0.0};
  const auto turn = [&](double motion) {
    Screw body;
    body.twist[3] = motion / (460.0 * camera.shutter.line_delay_s);
    body.start.R = SO3::exp<double>(Vector3d(-0.015 * body.twist[3], 0.0, 0.0));  // straight ahead at mid-frame
    return project(camera, body, far, LineMethod::kNewton);
  };
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_EQ(turn(sign * 0.7).status, LineStatus::kConverged);
    for (const double motion : {0.81, 1.0, 1.2, 3.0}) EXPECT_EQ(turn(sign * motion).status, LineStatus::kNotConvergent);
  }
}

TEST(RollingShutter, FastPointsFarOutsideAreOutside) {
  Screw body;
  body.twist << 0.0, 0.0, 0.0, 2.0, 0.0, 0.0;
  const auto sight = project(phone(), body, HomogeneousPoint::known({0.0, 40.0, 2.0}), LineMethod::kNewton);
  EXPECT_EQ(sight.status, LineStatus::kOutOfImage);
}

TEST(RollingShutter, FoundAlthoughTheLensHasNoImageOfItAtMidFrame) {
  // Equidistant lens whose polynomial turns at theta = 0.527: the point is beyond that from line 88 on.
  Camera camera = phone();
  camera.lens = make_lens(LensModel::kPinholeEquidistant, {600.0, 600.0, 319.5, 239.5, -1.2, 0.0, 0.0, 0.0});
  Screw body;
  body.twist << 0.0, 0.0, 0.0, -3.0, 0.0, 0.0;
  const HomogeneousPoint point{Vector3d(0.0, -std::sin(0.51), std::cos(0.51)), 0.0};
  ASSERT_TRUE(project_moving(camera, *body(0.0), point));
  ASSERT_FALSE(project_moving(camera, *body(0.015), point));
  const auto sight = project(camera, body, point, LineMethod::kNewton);
  EXPECT_EQ(sight.status, LineStatus::kConverged);
}

TEST(RollingShutter, FarFromTheOriginRoundingEndsTheSearch) {
  Screw body{SE3::exp<double>(Vector6d::Constant(0.2)), Vector6d::Constant(0.8)};
  body.start.p = {500000.0, 5000000.0, 300.0};
  const HomogeneousPoint point = HomogeneousPoint::known(body.start * Vector3d(0.1, 0.2, 1.5));
  const auto sight = project(phone(), body, point, LineMethod::kNewton);
  EXPECT_EQ(sight.status, LineStatus::kConverged);
  EXPECT_LE(std::abs(sight.line_error), 1e-6);
}

TEST(RollingShutter, WhiteningIsOneNewtonStep) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Camera camera = generic_camera(LensModel::kPinholeRadtan, static_cast<ReadoutDirection>(seed % 4), seed);
    Draw draw(seed + 70);
    const Screw body{SE3::exp<double>(draw.vector<6>(2.0)), draw.vector<6>(2.0)};
    const HomogeneousPoint point = point_near(camera, body.start, {400.0, 200.0}, 0.5);
    const LineProjection exact = project(camera, body, point, LineMethod::kNewton);
    const Vector2d observed_px = exact.px + draw.vector<2>(2.0);
    const double line = camera.shutter.line(observed_px, camera.resolution_px);
    const auto at_line =
        project_rolling_shutter(camera, point, body, {.method = LineMethod::kStatic, .start_line = line});
    const Eigen::Matrix2d M = newton_whitening(camera.shutter, at_line.rate_px_per_s).value();
    const double left = (M * (at_line.px - observed_px) - (exact.px - observed_px)).norm();
    const double unwhitened = (at_line.px - exact.px).norm();
    EXPECT_LE(left, 1e-3 * unwhitened + 1e-12);
  }
  EXPECT_FALSE(newton_whitening(phone().shutter, {0.0, 0.8 * 480.0 / 0.030}));
  EXPECT_EQ(newton_whitening(Shutter{}, {100.0, 1e6}).value(), Eigen::Matrix2d::Identity());
}

}  // namespace
}  // namespace vispline::testing

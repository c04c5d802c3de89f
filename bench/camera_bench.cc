/// Lenses, and the rolling-shutter projection beside plain bisection for the line of each point. The counters of
/// `steps/...` are the table of docs/math/camera.md: images computed and pixels left over, against the speed of the
/// motion.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "vispline/core/random.h"
#include "vispline/core/se3.h"
#include "vispline/sensors/rolling_shutter.h"
#include "vispline/simulate/body_instant.h"
#include "vispline/trajectory/analytic.h"

namespace vispline {
namespace {

/// 480 lines in 30 ms, f = 460 px.
Camera phone() {
  Camera camera;
  camera.lens.params << 460.0, 460.0, 319.5, 239.5;
  camera.shutter.line_delay_s = 0.030 / 480.0;
  camera.T_c_b.R << 0.0, -1.0, 0.0, 0.0, 0.0, -1.0, 1.0, 0.0, 0.0;  // looks along x of the body
  return camera;
}

Vector3d uniform3(const RandomStream& stream, std::uint64_t index) {
  const auto ab = stream.uniform_pair(2 * index), cd = stream.uniform_pair(2 * index + 1);
  return 2.0 * Vector3d(ab[0], ab[1], cd[0]) - Vector3d::Ones();
}

// ---- one call of a lens

Lens lens_of(LensModel model) {
  Lens lens{model, LensParams(lens_params(model))};
  for (int i = 0; i < lens.params.size(); ++i) {
    const std::string_view name = lens_param_name(model, i);
    const bool is_focal = name == "fu" || name == "fv", is_centre = name == "pu" || name == "pv";
    const bool is_shape = name == "xi" || name == "alpha" || name == "beta" || name == "w";
    lens.params[i] = is_focal ? 400.0 : is_centre ? 300.0 : is_shape ? 0.6 : 0.01;
  }
  return lens;
}

void linearize(benchmark::State& state, LensModel model) {
  const Lens lens = lens_of(model);
  Vector3d point_c(0.3, -0.2, 1.0);
  for (auto _ : state) {
    benchmark::DoNotOptimize(point_c);
    benchmark::DoNotOptimize(lens.linearize(point_c));
  }
}
BENCHMARK_CAPTURE(linearize, pinhole, LensModel::kPinhole);
BENCHMARK_CAPTURE(linearize, pinhole_radtan, LensModel::kPinholeRadtan);
BENCHMARK_CAPTURE(linearize, pinhole_equidistant, LensModel::kPinholeEquidistant);
BENCHMARK_CAPTURE(linearize, pinhole_fov, LensModel::kPinholeFov);
BENCHMARK_CAPTURE(linearize, omni_radtan, LensModel::kOmniRadtan);
BENCHMARK_CAPTURE(linearize, double_sphere, LensModel::kDoubleSphere);
BENCHMARK_CAPTURE(linearize, extended_unified, LensModel::kExtendedUnified);

// ---- 1000 landmarks in sight of each of the 600 frames of 20 s at 30 Hz

struct Recording20s {
  Trajectory trajectory = analytic_trajectory("ellipse", Time{}, std::chrono::seconds(21)).value();
  Camera camera = phone();
  SampleClock clock{Time{} + std::chrono::milliseconds(500), 30.0};
  std::vector<std::vector<HomogeneousPoint>> points{600};  ///< by frame

  Recording20s() {
    const RandomStream stream(1, "landmarks");
    for (std::size_t frame = 0; frame < points.size(); ++frame) {
      const Time middle = clock(static_cast<std::int64_t>(frame)) + std::chrono::milliseconds(15);
      const Pose T_w_c = trajectory.at(middle)->T_w_b() * camera.T_c_b.inverse();
      for (std::uint64_t i = 0; i < 1000; ++i) {
        const Vector3d where = uniform3(stream, 1000 * frame + i);
        const Vector2d px(319.5 + 310.0 * where.x(), 239.5 + 230.0 * where.y());
        points[frame].push_back(
            InverseDepthLandmark{camera.lens.unproject(px).value(), 1.0 / (3.5 + 2.5 * where.z())}.in_world(T_w_c));
      }
    }
  }
};

/// The search that needs no derivative: the line between the ends of the image at which line and instant agree.
std::optional<Vector2d> by_bisection(const Camera& camera, const HomogeneousPoint& point, const BodyAt& body_at) {
  double low = -0.5, high = camera.resolution_px[1] - 0.5;
  std::optional<Vector2d> px;
  while (high - low > 1e-9) {
    const double line = 0.5 * (low + high);
    const auto body = body_at(camera.shutter.line_delay_s * line);
    px = camera.lens.project(point.seen_from(body->T_w_b() * camera.T_c_b.inverse()));
    if (!px) return std::nullopt;
    (px->y() > line ? low : high) = line;
  }
  if (!camera.in_image(*px) || std::abs(px->y() - low) > 1e-6) return std::nullopt;
  return px;
}

template <class Project>
void project_all(benchmark::State& state, const Project& project) {
  const Recording20s recording;
  double seen = 0.0;
  for (auto _ : state) {
    for (std::size_t frame = 0; frame < recording.points.size(); ++frame) {
      const Time stamp = recording.clock(static_cast<std::int64_t>(frame));
      const auto body_at = [&](double delay_s) { return state_after(recording.trajectory, stamp, delay_s); };
      for (const HomogeneousPoint& point : recording.points[frame]) {
        const std::optional<Vector2d> px = project(recording.camera, point, BodyAt(body_at));
        benchmark::DoNotOptimize(px);
        seen += px ? 1.0 : 0.0;
      }
    }
  }
  state.counters["features_per_s"] = benchmark::Counter(seen, benchmark::Counter::kIsRate);
  state.counters["features"] = seen / static_cast<double>(state.iterations());
}

void baseline_bisection(benchmark::State& state) { project_all(state, by_bisection); }
BENCHMARK(baseline_bisection)->Unit(benchmark::kMillisecond);

void project_points(benchmark::State& state, LineMethod method) {
  const LineSearch search{.method = method, .tolerance_lines = 1e-9};
  project_all(state, [&](const Camera& camera, const HomogeneousPoint& point, const BodyAt& body_at) {
    const LineProjection sight = project_rolling_shutter(camera, point, body_at, search);
    return sight.status == LineStatus::kConverged ? std::optional<Vector2d>(sight.px) : std::nullopt;
  });
}
BENCHMARK_CAPTURE(project_points, newton, LineMethod::kNewton)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(project_points, first_order, LineMethod::kFirstOrder)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(project_points, fixed_point, LineMethod::kFixedPoint)->Unit(benchmark::kMillisecond);

// ---- images and pixels left over against the speed of the motion: worst of 60 points, 1 to 6 m away

/// Constant rates in the body's frame.
struct Screw {
  Vector6d twist;
  std::optional<BodyState> operator()(double t) const {
    const Pose T_w_b = SE3::exp<double>(Vector6d(t * twist));
    return BodyState{.R_w_b = T_w_b.R, .p_w = T_w_b.p, .v_w = T_w_b.R * twist.head<3>(), .omega_b = twist.tail<3>()};
  }
};

void steps(benchmark::State& state, LineMethod method, double omega, double speed) {
  Camera camera = phone();
  camera.T_c_b = {};
  const RandomStream stream(1, "motion");
  double motion = 0.0, images = 0.0;
  std::array<double, 4> left_px{};
  for (auto _ : state) {
    for (std::uint64_t i = 0; i < 60; ++i) {
      Screw body;
      body.twist << speed * uniform3(stream, 3 * i).normalized(), omega * uniform3(stream, 3 * i + 1).normalized();
      const Vector3d where = uniform3(stream, 3 * i + 2);
      const Vector3d bearing_c = camera.lens.unproject({319.5 + 220.0 * where.x(), 239.5 + 160.0 * where.y()}).value();
      const HomogeneousPoint point{bearing_c, 1.0 / (3.5 + 2.5 * where.z())};
      const auto project = [&](LineMethod by, int most_images) {
        return project_rolling_shutter(camera, point, body,
                                       {.method = by, .tolerance_lines = 1e-13, .max_iterations = most_images});
      };
      const LineProjection exact = project_rolling_shutter(camera, point, body);
      if (exact.status != LineStatus::kConverged) continue;
      motion = std::max(motion, std::abs(camera.shutter.line_delay_s * exact.rate_px_per_s.y()));
      int n = 1;
      while ((project(method, n).px - exact.px).norm() > 1e-6 && n < 50) ++n;
      images = std::max(images, static_cast<double>(n));
      for (int k = 0; k < 4; ++k) {
        double& left = left_px[static_cast<std::size_t>(k)];
        left = std::max(left, (project(method, k + 1).px - exact.px).norm());
      }
    }
  }
  state.counters["motion"] = motion;
  state.counters["images"] = images;
  for (std::size_t k = 0; k < 4; ++k) state.counters["px_after_" + std::to_string(k + 1)] = left_px[k];
}

#define VISPLINE_STEPS(method)                                                             \
  BENCHMARK_CAPTURE(steps, method / 1_rad_s, LineMethod::method, 1.0, 0.5)->Iterations(1); \
  BENCHMARK_CAPTURE(steps, method / 3_rad_s, LineMethod::method, 3.0, 1.5)->Iterations(1); \
  BENCHMARK_CAPTURE(steps, method / 6_rad_s, LineMethod::method, 6.0, 3.0)->Iterations(1); \
  BENCHMARK_CAPTURE(steps, method / 10_rad_s, LineMethod::method, 10.0, 3.0)->Iterations(1)
VISPLINE_STEPS(kNewton);
VISPLINE_STEPS(kFirstOrder);
VISPLINE_STEPS(kFixedPoint);

}  // namespace
}  // namespace vispline

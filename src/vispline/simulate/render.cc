#include "vispline/simulate/render.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "vispline/core/error.h"
#include "vispline/core/parallel.h"
#include "vispline/core/random.h"
#include "vispline/simulate/shade.h"

namespace vispline {
namespace {

constexpr int kChunk = 8;  // lines of one task
constexpr double kDistanceFloor_m = 1e-3;

void check(const RenderOptions& options) {
  require(options.supersampling >= 1 && options.supersampling <= 16, "1 to 16 rays a pixel in each direction");
  require(options.most_exposures >= 1 && options.most_exposures <= 1000, "1 to 1000 instants of an exposure");
  require(std::isfinite(options.gain) && options.gain >= 0.0, "a gain that is finite and not negative");
  require(options.vignette >= 0.0 && options.vignette <= 1.0, "a vignette from 0 to 1");
  require(std::isfinite(options.read_sigma_grey) && options.read_sigma_grey >= 0.0,
          "a read noise that is finite and not negative");
  require(options.background_grey >= 0.0 && options.background_grey <= 255.0, "a background from 0 to 255");
}

}  // namespace

struct Renderer::Parts {
  Scene scene;
  Camera camera;
  RenderOptions options;
  RayTable rays;
  Pose T_b_c;

  Parts(Scene s, Camera c, RenderOptions o)
      : scene(std::move(s)), camera(std::move(c)), options(o), rays(camera), T_b_c(camera.T_c_b.inverse()) {
    require_valid(scene);
    check(options);
  }

  /// Middle of the exposure of a line, on the body's clock.
  Time line_time(Time stamp, int line) const {
    return stamp + from_seconds(camera.delay_s(rays.pixel(line, 0).cast<double>()));
  }

  /// Instants over which the exposure of a line is averaged: so many that the image moves by no more than 1 px between
  /// two, by a bound for the nearest surface.                                                docs/math/rendering.md (3)
  int exposures(const BodyState& body) const {
    const double exposure_s = camera.shutter.exposure_s;
    if (exposure_s == 0.0) return 1;
    const Vector3d v_c_w = body.v_w + body.R_w_b * body.omega_b.cross(T_b_c.p);
    double nearest_m = std::numeric_limits<double>::infinity();
    for (const Surface& s : scene.surfaces) nearest_m = std::min(nearest_m, distance_to(s, body.T_w_b() * T_b_c.p));
    const double rate = body.omega_b.norm() + v_c_w.norm() / std::max(nearest_m, kDistanceFloor_m);
    const double moved_px = rate * exposure_s / rays.rad_per_px();
    return static_cast<int>(std::clamp(std::ceil(moved_px), 1.0, static_cast<double>(options.most_exposures)));
  }

  void expose(const Trajectory& trajectory, Time middle, int line, std::vector<SurfaceView>& views,
              std::vector<double>& grey) const {
    const int n = exposures(trajectory.at(middle).value());
    std::ranges::fill(grey, 0.0);
    for (int i = 0; i < n; ++i) {
      const Duration off = from_seconds(camera.shutter.exposure_s * ((i + 0.5) / n - 0.5));
      const Pose T_w_c = trajectory.at(middle + off).value().T_w_b() * T_b_c;
      views.clear();
      for (const Surface& surface : scene.surfaces) {
        if (const auto view = view_of(surface, T_w_c)) views.push_back(*view);
      }
      shade_line(rays, line, views, {options.supersampling, options.background_grey}, grey);
    }
    for (double& g : grey) g /= n;
  }

  /// 1 in the middle of the image, 1 - vignette in its corners.
  double light(const Eigen::Vector2i& px) const {
    const Vector2d half = 0.5 * Vector2d(camera.resolution_px[0] - 1, camera.resolution_px[1] - 1);
    return 1.0 - options.vignette * (px.cast<double>() - half).squaredNorm() / std::max(half.squaredNorm(), 1.0);
  }

  /// Light to bytes; two neighbours share one draw of noise.
  void develop(const std::vector<double>& grey, const RandomStream& noise, int line, GreyImage& image) const {
    const auto pairs_of_line = static_cast<std::uint64_t>(rays.places() + 1) / 2;
    std::array<double, 2> normals{};
    for (int place = 0; place < rays.places(); ++place) {
      const auto pair = static_cast<std::uint64_t>(line) * pairs_of_line + static_cast<std::uint64_t>(place) / 2;
      if (place % 2 == 0 && options.read_sigma_grey > 0.0) normals = noise.normal_pair(pair);
      if (!rays.ray(line, place).sees()) continue;
      const Eigen::Vector2i px = rays.pixel(line, place);
      const double lit = grey[static_cast<std::size_t>(place)] * light(px);
      const double read = options.gain * (lit + options.read_sigma_grey * normals[static_cast<std::size_t>(place % 2)]);
      image.at(px.x(), px.y()) = static_cast<std::uint8_t>(std::clamp(read + 0.5, 0.0, 255.0));
    }
  }
};

Renderer::Renderer(Scene scene, Camera camera, RenderOptions options)
    : parts_(std::make_unique<const Parts>(std::move(scene), std::move(camera), options)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

TimeSpan Renderer::exposed(Time stamp) const {
  const Duration half = from_seconds(0.5 * parts_->camera.shutter.exposure_s);
  const auto [first, last] =
      std::minmax({parts_->line_time(stamp, 0), parts_->line_time(stamp, parts_->rays.lines() - 1)});
  return {first - half, last + half};
}

std::optional<GreyImage> Renderer::render(const Trajectory& trajectory, Time stamp) const {
  const TimeSpan needed = exposed(stamp), given = trajectory.span();
  if (!given.contains(needed.begin) || !given.contains(needed.end)) return std::nullopt;
  const auto [width, height] = parts_->camera.resolution_px;
  GreyImage image{width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(width) * height, 0)};
  const RandomStream noise(parts_->options.seed, parts_->camera.name + "/image/" + std::to_string(to_ns(stamp)));
  const int lines = parts_->rays.lines();
  parallel_for((lines + kChunk - 1) / kChunk, parts_->options.threads, [&](std::size_t chunk) {
    std::vector<SurfaceView> views;
    std::vector<double> grey(static_cast<std::size_t>(parts_->rays.places()));
    const int begin = static_cast<int>(chunk) * kChunk;
    for (int line = begin; line < std::min(lines, begin + kChunk); ++line) {
      parts_->expose(trajectory, parts_->line_time(stamp, line), line, views, grey);
      parts_->develop(grey, noise, line, image);
    }
  });
  return image;
}

}  // namespace vispline

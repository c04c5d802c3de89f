#include "vispline/simulate/ray_table.h"

#include <algorithm>
#include <limits>

#include "vispline/core/error.h"

namespace vispline {
namespace {

constexpr int kBundle = 16;

PixelRay ray_of(const Lens& lens, const Eigen::Vector2i& px) {
  const std::optional<LensRay> ray = lens.linearize_ray(px.cast<double>());
  if (!ray) return {Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()), {}, {}};
  return {ray->bearing_c.cast<float>(), ray->d_px.col(0).cast<float>(), ray->d_px.col(1).cast<float>()};
}

}  // namespace

RayTable::RayTable(const Camera& camera)
    : direction_(camera.shutter.direction), lines_(camera.shutter.lines(camera.resolution_px)), places_(0) {
  require_valid(camera);
  places_ = camera.resolution_px[0] * camera.resolution_px[1] / lines_;
  rays_.reserve(static_cast<std::size_t>(lines_) * static_cast<std::size_t>(places_));
  for (int line = 0; line < lines_; ++line) {
    for (int place = 0; place < places_; ++place) {
      rays_.push_back(ray_of(camera.lens, pixel(line, place)));
      if (!rays_.back().sees()) continue;
      rad_per_px_ =
          std::min(rad_per_px_, static_cast<double>(std::min(rays_.back().d_x.norm(), rays_.back().d_y.norm())));
    }
  }
  for (int line = 0; line < lines_; ++line) {
    std::vector<RayBundle>& bundles = bundles_.emplace_back();
    for (int begin = 0; begin < places_; begin += kBundle) bundles.push_back(bundle(line, begin));
  }
}

RayBundle RayTable::bundle(int line, int begin) const {
  RayBundle bundle{.begin = begin, .end = std::min(begin + kBundle, places_)};
  int seeing = 0;
  for (int place = bundle.begin; place < bundle.end; ++place) {
    if (!ray(line, place).sees()) continue;
    bundle.axis_c += ray(line, place).bearing.cast<double>();
    ++seeing;
  }
  if (seeing == 0) return bundle;
  bundle.axis_c /= seeing;
  for (int place = bundle.begin; place < bundle.end; ++place) {
    const PixelRay& r = ray(line, place);
    if (!r.sees()) continue;
    const double half_pixel = 0.5 * (r.d_x.norm() + r.d_y.norm());
    bundle.reach = std::max(bundle.reach, (r.bearing.cast<double>() - bundle.axis_c).norm() + half_pixel);
  }
  return bundle;
}

Eigen::Vector2i RayTable::pixel(int line, int place) const {
  switch (direction_) {
    case ReadoutDirection::kDown:
      return {place, line};
    case ReadoutDirection::kUp:
      return {place, lines_ - 1 - line};
    case ReadoutDirection::kRight:
      return {line, place};
    case ReadoutDirection::kLeft:
      return {lines_ - 1 - line, place};
  }
  return {};
}

}  // namespace vispline

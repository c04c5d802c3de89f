#include "vispline/simulate/shade.h"

#include <algorithm>
#include <array>

#include "vispline/simulate/texture.h"

namespace vispline {
namespace {

constexpr double kPlainGrey = 128.0;  // of surfaces without a picture, and of backs

/// What a bundle may see: nothing but the surfaces in the list.
struct Candidates {
  std::vector<const SurfaceView*> views;
  bool is_sure = false;  ///< there is one, and every ray meets it
};

/// Surfaces that are surely behind one that every ray meets are left out.
void collect(std::span<const SurfaceView> views, const RayBundle& bundle, Candidates& candidates) {
  candidates.views.clear();
  double cover = 0.0;  // every ray meets something at this 1/distance or above
  bool is_covered = false;
  for (const SurfaceView& view : views) {
    const Coverage coverage = view.coverage(bundle);
    if (coverage == Coverage::kNone) continue;
    candidates.views.push_back(&view);
    if (coverage != Coverage::kAll) continue;
    is_covered = true;
    cover = std::max(cover, view.inverse_distances(bundle)[0]);
  }
  std::erase_if(candidates.views, [&](const SurfaceView* view) { return view->inverse_distances(bundle)[1] < cover; });
  candidates.is_sure = is_covered && candidates.views.size() == 1;
}

/// A pixel on the plane of a surface: h = to_picture * ray and how it moves over the image.
struct Footprint {
  const SurfaceView* view;
  Vector3d h, h_x, h_y;

  Footprint(const SurfaceView& v, const PixelRay& ray)
      : view(&v),
        h(v.to_picture * ray.bearing.cast<double>()),
        h_x(v.to_picture * ray.d_x.cast<double>()),
        h_y(v.to_picture * ray.d_y.cast<double>()) {}
  Vector3d at(double dx, double dy) const { return h + dx * h_x + dy * h_y; }
  /// Half sizes of the box around a square of `size` px at the point with `h_at`.
  Vector2d bounding_box(const Vector3d& h_at, double size) const {
    const auto [right, down] = steps(h_at, 0.5 * size);
    return right.cwiseAbs() + down.cwiseAbs();
  }
  /// Half sizes of the box that blurs as much along x and y as the square does: of equal variance.
  Vector2d equal_box(const Vector3d& h_at, double size) const {
    const auto [right, down] = steps(h_at, 0.5 * size);
    return (right.cwiseAbs2() + down.cwiseAbs2()).cwiseSqrt();
  }

 private:
  /// How far a step of `size` px to the right and down goes on the picture.
  std::array<Vector2d, 2> steps(const Vector3d& h_at, double size) const {
    const double s = 1.0 / h_at[2], x = h_at[0] * s, y = h_at[1] * s, scale = size * s;
    return {Vector2d(h_x[0] - x * h_x[2], h_x[1] - y * h_x[2]) * scale,
            Vector2d(h_y[0] - x * h_y[2], h_y[1] - y * h_y[2]) * scale};
  }
};

/// Runs work(dx, dy) for the middles of the sub-pixels and returns the mean.
template <class Work>
double mean_of_subpixels(int n, const Work& work) {
  double sum = 0.0;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) sum += work((i + 0.5) / n - 0.5, (j + 0.5) / n - 0.5);
  }
  return sum / (n * n);
}

/// A pixel that sees one surface only. Rays beside each other matter where cells have sharp edges.
double shade_inside(const Footprint& foot, int n) {
  if (foot.view->picture == nullptr) return kPlainGrey;
  const Texture& picture = *foot.view->picture;
  const double x = foot.h[0] / foot.h[2], y = foot.h[1] / foot.h[2];
  if (picture.is_smooth()) {
    const Vector2d half = foot.equal_box(foot.h, 1.0);
    return picture.mean(x, y, half.x(), half.y());
  }
  const Vector2d bound = foot.bounding_box(foot.h, 1.0);
  if (const auto flat = picture.flat(x, y, bound.x(), bound.y())) return *flat;
  const Vector2d half = foot.equal_box(foot.h, 1.0 / n);
  return mean_of_subpixels(n, [&](double dx, double dy) {
    const Vector3d h = foot.at(dx, dy);
    return picture.mean(h[0] / h[2], h[1] / h[2], half.x(), half.y());
  });
}

/// A pixel that may see several surfaces or past them: the nearest one for every ray.
double shade_edge(std::span<const Footprint> feet, const Shading& shading) {
  const int n = shading.supersampling;
  return mean_of_subpixels(n, [&](double dx, double dy) {
    const Footprint* nearest = nullptr;
    Vector3d h_nearest = Vector3d::Zero();
    for (const Footprint& foot : feet) {
      const Vector3d h = foot.at(dx, dy);
      if (!SurfaceView::is_hit(h) || h[2] <= h_nearest[2]) continue;
      nearest = &foot;
      h_nearest = h;
    }
    if (nearest == nullptr) return shading.background_grey;
    if (nearest->view->picture == nullptr) return kPlainGrey;
    const Vector2d half = nearest->equal_box(h_nearest, 1.0 / n);
    return nearest->view->picture->mean(h_nearest[0] / h_nearest[2], h_nearest[1] / h_nearest[2], half.x(), half.y());
  });
}

}  // namespace

void shade_line(const RayTable& rays, int line, std::span<const SurfaceView> views, const Shading& shading,
                std::span<double> grey) {
  Candidates candidates;
  std::vector<Footprint> feet;
  for (const RayBundle& bundle : rays.bundles(line)) {
    if (bundle.reach < 0.0) continue;
    collect(views, bundle, candidates);
    for (int place = bundle.begin; place < bundle.end; ++place) {
      const PixelRay& ray = rays.ray(line, place);
      if (!ray.sees()) continue;
      double& sum = grey[static_cast<std::size_t>(place)];
      if (candidates.is_sure) {
        sum += shade_inside(Footprint(*candidates.views.front(), ray), shading.supersampling);
        continue;
      }
      feet.clear();
      for (const SurfaceView* view : candidates.views) feet.emplace_back(*view, ray);
      sum += shade_edge(feet, shading);
    }
  }
}

}  // namespace vispline

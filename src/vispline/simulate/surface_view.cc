#include "vispline/simulate/surface_view.h"

namespace vispline {

SurfaceView::SurfaceView(const Surface& surface, const Pose& T_s_c)
    : picture(T_s_c.p.z() > 0.0 ? surface.texture.get() : nullptr) {
  const Eigen::RowVector3d depth = -T_s_c.R.row(2) / T_s_c.p.z();
  to_picture << (T_s_c.R.row(0) + T_s_c.p.x() * depth) / surface.size_m.x(),
      (T_s_c.R.row(1) + T_s_c.p.y() * depth) / surface.size_m.y(), depth;
  const Vector3d x = to_picture.row(0), y = to_picture.row(1), w = to_picture.row(2);
  inside = {w, x, w - x, y, w - y};
  for (std::size_t i = 0; i < inside.size(); ++i) inside_norm[i] = inside[i].norm();
}

Coverage SurfaceView::coverage(const RayBundle& bundle) const {
  bool all = true;
  for (std::size_t i = 0; i < inside.size(); ++i) {
    const double middle = inside[i].dot(bundle.axis_c), spread = inside_norm[i] * bundle.reach;
    if (middle + spread <= 0.0) return Coverage::kNone;
    all = all && middle - spread > 0.0;
  }
  return all ? Coverage::kAll : Coverage::kSome;
}

std::array<double, 2> SurfaceView::inverse_distances(const RayBundle& bundle) const {
  const double middle = inside[0].dot(bundle.axis_c), spread = inside_norm[0] * bundle.reach;
  return {middle - spread, middle + spread};
}

std::optional<SurfaceView> view_of(const Surface& surface, const Pose& T_w_c) {
  const Pose T_s_c = surface.T_w_s.inverse() * T_w_c;
  if (T_s_c.p.z() == 0.0) return std::nullopt;
  return SurfaceView(surface, T_s_c);
}

double distance_to(const Surface& surface, const Vector3d& p_w) {
  const Vector3d p_s = surface.T_w_s.inverse() * p_w;
  const Vector2d nearest = p_s.head<2>().cwiseMax(Vector2d::Zero()).cwiseMin(surface.size_m);
  return (p_s - Vector3d(nearest.x(), nearest.y(), 0.0)).norm();
}

}  // namespace vispline

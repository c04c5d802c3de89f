#include "vispline/simulate/shutter_view.h"

#include "vispline/sensors/rolling_shutter.h"

namespace vispline {

ShutterView::ShutterView(const Trajectory& trajectory, const Camera& camera, const FrameInstant& instant)
    : trajectory_(trajectory), camera_(camera), instant_(instant) {}

std::optional<BodyState> ShutterView::body_at(double delay_s) const {
  return state_after(trajectory_, instant_.stamp, instant_.clock_delay_s + delay_s);
}

bool ShutterView::is_covered() const {
  const double line_delay_s = camera_.shutter.line_delay_s, first_s = camera_.time_offset_s;
  const double last_s = first_s + line_delay_s * camera_.shutter.lines(camera_.resolution_px);
  return body_at(first_s - line_delay_s).has_value() && body_at(last_s).has_value();
}

ShutterSight ShutterView::see(const Scene& scene, const SceneLandmark& landmark) const {
  const auto at = [this](double delay_s) { return body_at(delay_s); };
  const LineProjection line = project_rolling_shutter(camera_, HomogeneousPoint::known(landmark.point_w), at);
  if (line.status == LineStatus::kNotConvergent) return {.px = std::nullopt, .is_unsolved = true};
  if (line.status != LineStatus::kConverged || !camera_.in_image(line.px)) return {};
  const Vector3d p_w = (body_at(line.delay_s).value().T_w_b() * camera_.T_c_b.inverse()).p;
  if (!scene.in_sight(p_w, landmark)) return {};
  return {.px = line.px};
}

}  // namespace vispline

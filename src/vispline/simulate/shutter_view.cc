#include "vispline/simulate/shutter_view.h"

#include <algorithm>
#include <cmath>

namespace vispline {
namespace {

constexpr int kMostSteps = 25;
constexpr double kExact_s = 1e-15;
constexpr double kRounding_s = 1e-11;  // an error that no longer shrinks is rounding, if it is as small as this
/// Beyond it the line nearly keeps up with the image, and the root is not to be trusted.
constexpr double kMostSlope = 0.8;

/// One evaluation of g(s), the delay of the line that sees the landmark at s, and its slope.
struct LineDelay {
  Vector2d px;
  double delay_s = 0.0;
  double slope = 0.0;
};

std::optional<LineDelay> line_delay(const Camera& camera, const BodyState& body, const Vector3d& point_w) {
  const Vector3d point_b = body.R_w_b.transpose() * (point_w - body.p_w);
  const auto seen = camera.lens.linearize(camera.T_c_b * point_b);
  if (!seen) return std::nullopt;
  const Vector3d velocity_b = point_b.cross(body.omega_b) - body.R_w_b.transpose() * body.v_w;
  const Vector2d px_rate = seen->d_point * (camera.T_c_b.R * velocity_b);
  return LineDelay{seen->px, camera.delay_s(seen->px),
                   camera.shutter.line_delay_s * camera.shutter.line_gradient().dot(px_rate)};
}

}  // namespace

ShutterView::ShutterView(const Trajectory& trajectory, const Camera& camera, const FrameInstant& instant)
    : trajectory_(trajectory), camera_(camera), instant_(instant) {
  const double line_delay_s = camera.shutter.line_delay_s;
  first_s_ = camera.time_offset_s - line_delay_s;
  last_s_ = camera.time_offset_s + line_delay_s * camera.shutter.lines(camera.resolution_px);
}

bool ShutterView::is_covered() const {
  const TimeSpan span = trajectory_.span();
  const auto at = [&](double delay_s) { return instant_.stamp + from_seconds(instant_.clock_delay_s + delay_s); };
  return span.contains(at(first_s_)) && span.contains(at(last_s_));
}

ShutterSight ShutterView::see(const Scene& scene, const SceneLandmark& landmark) const {
  double delay_s = 0.5 * (first_s_ + last_s_), last_error_s = 1.0;
  for (int step = 0; step < kMostSteps; ++step) {
    const BodyState body = body_at(delay_s);
    const auto line = line_delay(camera_, body, landmark.point_w);
    if (!line) return {};
    const double error_s = line->delay_s - delay_s;
    const bool is_rounding = std::abs(error_s) <= kRounding_s && std::abs(error_s) >= last_error_s;
    last_error_s = std::abs(error_s);
    if (std::abs(error_s) <= kExact_s || is_rounding) {
      if (!camera_.in_image(line->px)) return {};
      const Vector3d p_w = (body.T_w_b() * camera_.T_c_b.inverse()).p;
      if (!scene.in_sight(p_w, landmark)) return {};
      if (std::abs(line->slope) > kMostSlope) return {.px = std::nullopt, .is_unsolved = true};
      return {.px = line->px};
    }
    const double next_s = std::clamp(delay_s + error_s / (1.0 - line->slope), first_s_, last_s_);
    if (next_s == delay_s) return {};  // at the edge: its line is outside the image
    delay_s = next_s;
  }
  return {.px = std::nullopt, .is_unsolved = true};
}

}  // namespace vispline

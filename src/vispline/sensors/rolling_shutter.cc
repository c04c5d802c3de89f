#include "vispline/sensors/rolling_shutter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vispline/core/error.h"

namespace vispline {
namespace {

constexpr double kFirstOrderStep = 1e-4;  // lines; the error of (12) is of second order: 1e-11 lines or less
constexpr double kRounding = 1e-6;        // lines
constexpr int kRetreats = 8;

class Search {
 public:
  Search(const Camera& camera, const HomogeneousPoint& point, BodyAt body_at, const LineSearch& search)
      : camera_(camera), point_(point), body_at_(body_at), search_(search), e_(camera.shutter.line_gradient()) {}

  LineProjection run() {
    last_line_ = camera_.shutter.lines(camera_.resolution_px) - 1;
    line_ = search_.start_line.value_or(0.5 * last_line_);
    if (search_.method == LineMethod::kStatic || camera_.shutter.line_delay_s == 0.0) return at_start_line();
    line_ = std::clamp(line_, -0.5, last_line_ + 0.5);
    if (!find_start()) return result_;
    while (true) {
      const double motion = camera_.shutter.line_delay_s * e_.dot(result_.rate_px_per_s);
      if (!(std::abs(motion) < kMostLineMotion)) return too_fast();
      if (is_root()) return at_root();
      if (result_.iterations >= search_.max_iterations) return ended(LineStatus::kNotConvergent);
      const double slope = search_.method == LineMethod::kFixedPoint ? 1.0 : 1.0 - motion;
      const double step = result_.line_error / slope;
      if (search_.method == LineMethod::kFirstOrder && std::abs(step) <= kFirstOrderStep) return extrapolated(step);
      const double next = std::clamp(line_ + step, -0.5, last_line_ + 0.5);
      if (next == line_) return ended(LineStatus::kOutOfImage);
      if (!advance(next)) return result_;
    }
  }

 private:
  double delay_s(double line) const { return camera_.time_offset_s + camera_.shutter.line_delay_s * line; }

  LineProjection ended(LineStatus status) {
    result_.status = status;
    return result_;
  }

  LineProjection at_root() {
    return ended(camera_.in_image(result_.px) ? LineStatus::kConverged : LineStatus::kOutOfImage);
  }

  LineProjection at_start_line() {
    if (!look(line_) || search_.method == LineMethod::kStatic) return result_;
    result_.line_error = 0.0;  // all lines have this instant
    return at_root();
  }

  /// Far outside the image, points are always fast; that is no failure of the search.
  LineProjection too_fast() {
    bool is_ever_inside = false;
    for (const double part : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      is_ever_inside |= look(part * last_line_) && camera_.in_image(result_.px);
    }
    return ended(is_ever_inside ? LineStatus::kNotConvergent : LineStatus::kOutOfImage);
  }

  /// (12): the pixel moves on along its velocity to the root of the line.
  LineProjection extrapolated(double step) {
    const double dt = camera_.shutter.line_delay_s * step;
    result_.px += dt * result_.rate_px_per_s;
    result_.delay_s += dt;
    result_.line_error = 0.0;
    return at_root();
  }

  /// Image at the instant of a line. False, with the reason as status, if there is none.
  bool look(double line) {
    ++result_.iterations;
    const std::optional<BodyState> state = body_at_(delay_s(line));
    const std::optional<MovingPixel> image = state ? project_moving(camera_, *state, point_) : std::nullopt;
    result_.status = image ? LineStatus::kConverged : state ? LineStatus::kBehindCamera : LineStatus::kOutsideCurve;
    if (!image) return false;
    line_ = line;
    result_.px = image->px;
    result_.rate_px_per_s = image->rate_px_per_s;
    result_.delay_s = delay_s(line);
    result_.line_error = camera_.shutter.line(image->px, camera_.resolution_px) - line;
    return true;
  }

  /// At the first line asked for; if the lens has no image there, at either end.
  bool find_start() {
    look(line_);
    for (const double end : {0.0, last_line_}) {
      if (result_.status == LineStatus::kBehindCamera) look(end);
    }
    return result_.status == LineStatus::kConverged;
  }

  /// Far from the origin of w, rounding may end the search before the tolerance does.
  bool is_root() {
    const double error = std::abs(result_.line_error);
    const bool stalled = error >= previous_error_ && error <= kRounding;
    previous_error_ = error;
    return stalled || error <= search_.tolerance_lines;
  }

  /// To `next`, or less far where the lens has no image there.
  bool advance(double next) {
    const double from = line_;
    while (!look(next)) {
      if (result_.status == LineStatus::kOutsideCurve || ++retreats_ > kRetreats) return false;
      next = 0.5 * (from + next);
    }
    return true;
  }

  const Camera& camera_;
  const HomogeneousPoint& point_;
  BodyAt body_at_;
  const LineSearch& search_;
  const Vector2d e_;
  double last_line_ = 0.0;
  double line_ = 0.0;
  double previous_error_ = std::numeric_limits<double>::infinity();
  int retreats_ = 0;
  LineProjection result_{};
};

}  // namespace

LineProjection project_rolling_shutter(const Camera& camera, const HomogeneousPoint& point, BodyAt body_at,
                                       const LineSearch& search) {
  require(search.method != LineMethod::kStatic || search.start_line, "the observed line of a static projection");
  return Search(camera, point, body_at, search).run();
}

std::optional<MovingPixel> project_moving(const Camera& camera, const BodyState& state, const HomogeneousPoint& point) {
  const double rho = point.inverse_distance;
  const Matrix3d& R_c_b = camera.T_c_b.R;
  const Vector3d point_b = state.R_w_b.transpose() * (point.direction_w - rho * state.p_w);  // times rho
  const auto image = camera.lens.linearize(R_c_b * point_b + rho * camera.T_c_b.p);
  if (!image) return std::nullopt;
  const Vector3d rate_b = point_b.cross(state.omega_b) - rho * (state.R_w_b.transpose() * state.v_w);
  return MovingPixel{image->px, image->d_point * (R_c_b * rate_b)};
}

std::optional<Eigen::Matrix2d> newton_whitening(const Shutter& shutter, const Vector2d& rate_px_per_s) {
  const Vector2d e = shutter.line_gradient();
  const double motion = shutter.line_delay_s * e.dot(rate_px_per_s);
  if (!(std::abs(motion) < kMostLineMotion)) return std::nullopt;
  return Eigen::Matrix2d(Eigen::Matrix2d::Identity() +
                         (shutter.line_delay_s / (1.0 - motion)) * rate_px_per_s * e.transpose());
}

}  // namespace vispline

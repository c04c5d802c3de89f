/// Where a camera with a rolling shutter sees a point: the line is exposed when the pixel is on it, so that the pixel
/// and its instant are found together. docs/math/camera.md, Rolling shutter; Lovegrove et al. 2013, equations (12),
/// (13).
#pragma once

#include <optional>

#include "vispline/core/body_state.h"
#include "vispline/sensors/camera.h"
#include "vispline/sensors/landmark.h"

namespace vispline {

/// A reference to a callable: state of the body some seconds after the stamp of the frame, on the body's clock; empty
/// outside the curve. It must be continuous: the nanosecond of a Time is too coarse for a fast pixel.
class BodyAt {
 public:
  template <class Callable>
  BodyAt(const Callable& callable)  // NOLINT: a lambda is to be passed as it is
      : object_(&callable), call_([](const void* object, double delay_s) -> std::optional<BodyState> {
          return (*static_cast<const Callable*>(object))(delay_s);
        }) {}
  std::optional<BodyState> operator()(double delay_s) const { return call_(object_, delay_s); }

 private:
  const void* object_;
  std::optional<BodyState> (*call_)(const void*, double);
};

enum class LineMethod {
  kStatic,      ///< no search: the image at the instant of `start_line`, for an observed pixel
  kFirstOrder,  ///< the paper's: linearise the pixel in time (12), go to the line's root (13); the last pixel is (12)
  kNewton,      ///< the same steps, but the pixel is that of the trajectory itself, to the last digits
  kFixedPoint,  ///< without derivative: next line = line of the pixel
};

struct LineSearch {
  LineMethod method = LineMethod::kNewton;
  std::optional<double> start_line{};  ///< default: the middle of the image
  double tolerance_lines = 1e-10;      ///< largest line_error; up to 1e-6 where rounding leaves no less
  int max_iterations = 50;
};

enum class LineStatus {
  kConverged,
  kBehindCamera,   ///< the lens has no image of the point
  kOutOfImage,     ///< no line of this frame sees the point
  kNotConvergent,  ///< in the image, but moves by kMostLineMotion or more while a line is read; or out of iterations
  kOutsideCurve,   ///< the state of the body is not known at a needed instant
};

/// |line_delay * d line / dt| of the image of a point: below, one and only one line sees it, and Newton converges.
inline constexpr double kMostLineMotion = 0.8;

/// All but the status are meaningful only if it is kConverged.
struct LineProjection {
  LineStatus status = LineStatus::kConverged;
  Vector2d px = Vector2d::Zero();
  Vector2d rate_px_per_s = Vector2d::Zero();  ///< d px / dt as the body moves on
  double delay_s = 0.0;                       ///< of the instant of the image from the stamp, on the body's clock
  double line_error = 0.0;                    ///< line of px minus line of the instant
  int iterations = 0;                         ///< images computed
};

LineProjection project_rolling_shutter(const Camera& camera, const HomogeneousPoint& point, BodyAt body_at,
                                       const LineSearch& search = {});

/// The image of a point at one instant, and its velocity. docs/math/camera.md (18)
struct MovingPixel {
  Vector2d px;
  Vector2d rate_px_per_s;
};
/// Empty where the lens has no image of the point.
std::optional<MovingPixel> project_moving(const Camera& camera, const BodyState& state, const HomogeneousPoint& point);

/// One Newton step of the line's equation as a matrix on the residual r = px at the observed line - observed px, and
/// with it on all its derivatives. The observed line has the noise of the pixel; M takes its correlation out.
///   M = I + l rate e^T / (1 - l e.rate),   l = line_delay, e = d line / d px                docs/math/camera.md (22)
/// Empty where |l e.rate| >= kMostLineMotion.
std::optional<Eigen::Matrix2d> newton_whitening(const Shutter& shutter, const Vector2d& rate_px_per_s);

}  // namespace vispline

/// The trajectory as the estimator sees it: states at instants, and rows of any sensor carried back to the knots.
/// Which group and which order of spline is decided once, in make_curve(). docs/math/estimate.md, The curve.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "vispline/core/body_state.h"
#include "vispline/core/time.h"
#include "vispline/trajectory/fit.h"
#include "vispline/trajectory/trajectory.h"

namespace vispline {

/// time + extra_s on the body's clock. The second part is a double, so that offsets move an instant smoothly.
struct Instant {
  Time time{};
  double extra_s = 0.0;
};

inline constexpr int kMaxOrder = 6;

/// Rows with respect to the knots first, first + 1, ...: six columns a knot, in the tangent of the curve's group.
template <int kRows>
struct KnotRows {
  std::size_t first = 0;
  Eigen::Matrix<double, kRows, Eigen::Dynamic, Eigen::ColMajor, kRows, 6 * kMaxOrder> J;
};

/// Derivatives by the pose carried to the knots; block by block, whose sizes the compiler knows.
template <int kRows>
KnotRows<kRows> operator*(const Eigen::Matrix<double, kRows, 6>& d_pose, const KnotRows<6>& d_knots) {
  KnotRows<kRows> rows{d_knots.first, {}};
  rows.J.resize(kRows, d_knots.J.cols());
  for (Eigen::Index k = 0; k < d_knots.J.cols(); k += 6) {
    rows.J.template middleCols<6>(k).noalias() = d_pose.lazyProduct(d_knots.J.template middleCols<6>(k));
  }
  return rows;
}

/// A pose with its velocity, and the derivatives of the pose.
struct PoseSample {
  Pose T_w_b;
  Vector6d twist_b;     ///< (velocity, omega) of the body in frame b: d T_w_b / dt on the right
  KnotRows<6> d_knots;  ///< of the right perturbation (position, rotation) of T_w_b; empty unless asked for
};

class Curve {
 public:
  virtual ~Curve() = default;

  virtual SplineKind kind() const = 0;
  virtual int order() const = 0;
  virtual TimeSpan span() const = 0;
  virtual Duration spacing() const = 0;
  virtual std::size_t knots() const = 0;
  /// Instant at which knot k has most weight.
  virtual Time knot_time(std::size_t k) const = 0;
  /// First of the order() knots that an instant depends on.
  virtual std::size_t first_knot(const Instant& at) const = 0;

  virtual BodyState state(const Instant& at) const = 0;
  virtual Pose pose(const Instant& at) const = 0;
  virtual PoseSample sample(const Instant& at, bool derivatives) const = 0;

  /// Rows of a pixel; d_pose given the pose and its twist.
  using PixelRows = std::function<Eigen::Matrix<double, 2, 6>(const Pose& T_w_b, const Vector6d& twist_b)>;
  virtual KnotRows<2> pull_back_pixel(const Instant& at, const PixelRows& d_pose) const = 0;

  /// Rows of the six readings of an IMU; d_state given the state and its rate of change.
  using ImuRows = std::function<BodyJacobian<6>(const BodyState&, const BodyTangent& rate)>;
  virtual KnotRows<6> pull_back(const Instant& at, const ImuRows& d_state) const = 0;

  /// d_k+1 - d_k of the increments between knots k, k+1, k+2, and its derivatives: zero for a steady motion.
  struct Bend {
    Vector6d value;
    Eigen::Matrix<double, 6, 18> J;
  };
  virtual Bend bend(std::size_t k) const = 0;

  /// Knot k becomes X_k exp(delta_k).
  virtual void retract(const std::vector<Vector6d>& delta) = 0;
  virtual const std::vector<Pose>& knot_poses() const = 0;
  virtual std::unique_ptr<Curve> clone() const = 0;
  /// The curve as a value of its own.
  virtual Trajectory trajectory() const = 0;
};

struct CurveShape {
  SplineKind kind = SplineKind::kJoint;
  int order = 4;  ///< 4, 5 or 6
  Duration spacing = from_seconds(0.1);
};

/// A curve over `span` whose knots are `pose_at(knot_time)`. Throws Error for another order or no spacing.
std::unique_ptr<Curve> make_curve(const CurveShape& shape, TimeSpan span, const std::function<Pose(Time)>& pose_at);

}  // namespace vispline

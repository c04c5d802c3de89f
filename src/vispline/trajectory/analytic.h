/// Motions given by a formula of time, exact in every derivative. docs/math/trajectories.md has the formulas.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vispline/core/body_state.h"
#include "vispline/core/time.h"
#include "vispline/trajectory/taylor.h"
#include "vispline/trajectory/trajectory.h"

namespace vispline {

/// Pose of body b in world w as functions of time, R_w_b = Rz(yaw) Ry(pitch) Rx(roll).
struct AnalyticMotion {
  std::array<Taylor, 3> p_w;             ///< m
  std::array<Taylor, 3> roll_pitch_yaw;  ///< rad
};

/// A motion as a function of t, seconds since the start of the curve.
using AnalyticFormula = AnalyticMotion (*)(const Taylor& t);

/// State of a motion: omega_b = vee(R^T R'), alpha_b = vee(skew part of R^T R'').       docs/math/trajectories.md (5)
BodyState body_state(const AnalyticMotion& motion);

/// A formula on the closed interval [start, start + duration]. Time is never accumulated: a day does not drift.
class AnalyticCurve {
 public:
  AnalyticCurve(AnalyticFormula formula, Time start, Duration duration)
      : formula_(formula), span_{start, start + duration} {}

  TimeSpan span() const { return span_; }
  /// The formula is valid outside span() as well.
  BodyState at(Time time) const { return body_state(formula_(Taylor::time(to_seconds(time - span_.begin)))); }

 private:
  AnalyticFormula formula_;
  TimeSpan span_;
};

/// The names that analytic_trajectory() knows: ellipse, static, line, figure-eight, dance.
std::vector<std::string> analytic_names();

/// The named motion on [start, start + duration]; empty if the name is unknown. Throws Error for a negative duration.
std::optional<Trajectory> analytic_trajectory(std::string_view name, Time start, Duration duration);

}  // namespace vispline

/// The state of a body at instants finer than a nanosecond, as the root of a rolling shutter needs.
#pragma once

#include <cmath>
#include <optional>

#include "vispline/core/so3.h"
#include "vispline/trajectory/trajectory.h"

namespace vispline {

/// `state` dt seconds later, to first order in rates and second order in position; for |dt| below a nanosecond the rest
/// is smaller than rounding.
inline BodyState extended(const BodyState& state, double dt) {
  BodyState later = state;
  later.R_w_b = state.R_w_b * SO3::exp<double>(Vector3d(dt * state.omega_b));
  later.p_w += dt * (state.v_w + 0.5 * dt * state.a_w);
  later.v_w += dt * state.a_w;
  later.omega_b += dt * state.alpha_b;
  return later;
}

/// State at `base` + `delay_s`, continuous in the delay; empty if the nearest nanosecond lies outside the trajectory.
inline std::optional<BodyState> state_after(const Trajectory& trajectory, Time base, double delay_s) {
  const Duration whole = from_seconds(delay_s);
  const std::optional<BodyState> state = trajectory.at(base + whole);
  if (!state) return std::nullopt;
  return extended(*state, delay_s - 1e-9 * static_cast<double>(whole.count()));
}

}  // namespace vispline

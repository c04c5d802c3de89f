/// The inverse of a distortion that has no closed form.
#pragma once

#include <Eigen/LU>
#include <optional>

#include "vispline/sensors/lenses/stage.h"

namespace vispline::lenses {

/// The m of D's domain with distort(m) = d, to the last digits; empty if there is none. Newton's method from the
/// centre, with steps halved until they stay in the domain and come nearer, so that another branch is never entered.
template <class D>
std::optional<Vector2d> undistort_by_newton(const double* params, const Vector2d& d) {
  constexpr double kRelativeError = 1e-14;
  constexpr int kIterations = 100, kHalvings = 40;
  Vector2d m = Vector2d::Zero();
  auto at_m = D::linearize(params, m);
  if (!at_m) return std::nullopt;
  double error = d.norm();
  for (int i = 0; i < kIterations && error > 0.0; ++i) {
    const Vector2d step = at_m->d_input.inverse() * (d - at_m->m);
    bool nearer = false;
    double fraction = 1.0;
    for (int j = 0; j < kHalvings && !nearer; ++j, fraction *= 0.5) {
      const Vector2d trial = m + fraction * step;
      const auto at_trial = D::linearize(params, trial);
      if (!at_trial || !((d - at_trial->m).norm() < error)) continue;
      nearer = true;
      m = trial;
      at_m = at_trial;
      error = (d - at_m->m).norm();
    }
    if (!nearer) break;
  }
  if (!(error <= kRelativeError * (1.0 + d.norm()))) return std::nullopt;
  return m;
}

}  // namespace vispline::lenses

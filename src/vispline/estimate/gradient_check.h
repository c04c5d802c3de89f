/// Is the solution where the cost is lowest, and is the cost as steep as the sigmas say? Asked of the cost itself, by
/// differences: derivatives that are wrong do not pass. docs/math/uncertainty.md, Gradient check.
#pragma once

#include <cstddef>

#include "vispline/estimate/normal_equations.h"
#include "vispline/estimate/solve.h"

namespace vispline {

struct GradientCheck {
  double farthest_sigmas = 0.0;  ///< largest distance to the lowest cost along any parameter, in its sigma
  double curvature_low = 1.0;    ///< of the cost along a parameter over that of the information matrix
  double curvature_high = 1.0;
};

/// Along each parameter, everything else following as the information matrix says. Defaults without full rank.
GradientCheck check_gradient(const Problem& problem, const Solution& solution, const NormalEquations& equations,
                             std::size_t threads);

}  // namespace vispline

/// The same problem through Ceres: slower than our own solver and independent of its linear algebra and its damping, so
/// each is the other's test. docs/math/estimate.md, The solver.
#pragma once

#include "vispline/estimate/solve.h"

namespace vispline {

/// Moves solution.state, whose columns are assigned, to the minimum; fills all but rank and covariance.
void minimize_with_ceres(Problem& problem, const SolveOptions& options, Solution& solution);

}  // namespace vispline

/// What the residuals say of parameters that were held: a score test (Rao 1948). docs/math/uncertainty.md.
#pragma once

#include "vispline/estimate/solve.h"
#include "vispline/results/calibration_result.h"

namespace vispline {

/// Those that the residuals object to, the worst first. One linearisation with everything free. Needs a solution with
/// covariance.
std::vector<HeldParameter> held_parameters(const Problem& problem, const Solution& solution, std::size_t threads);

}  // namespace vispline

/// Residuals of every sensor at a solution: size, what the unknowns absorbed, whiteness. docs/math/uncertainty.md,
/// Residuals.
#pragma once

#include <vector>

#include "vispline/estimate/normal_equations.h"
#include "vispline/estimate/solve.h"
#include "vispline/results/calibration_result.h"

namespace vispline {

/// One entry for each sensor, in the order of the problem; sensors that are not used and priors have none.
std::vector<SensorResiduals> residual_statistics(const Problem& problem, const Solution& solution,
                                                 const NormalEquations& equations, std::size_t threads);

}  // namespace vispline

/// Which directions of the parameters a recording measures badly or not at all, in words, with the motion that mends
/// it. docs/math/uncertainty.md, Weak directions.
#pragma once

#include <vector>

#include "vispline/estimate/normal_equations.h"
#include "vispline/estimate/solve.h"
#include "vispline/results/calibration_result.h"

namespace vispline {

/// Directions along which one sigma is more than the limits of docs/math/uncertainty.md: eigenvectors of the covariance
/// scaled by the limits. Empty without full rank.
std::vector<WeakDirection> weak_directions(const Solution& solution);

/// Directions that are not measured: those whose variance in a hardly damped system is as large as the damping lets it
/// be. One with empty `part` if it lies in the trajectory or the landmarks alone.
std::vector<WeakDirection> null_directions(const Solution& solution, const NormalEquations& equations);

}  // namespace vispline

/// How many degrees of freedom of each sensor the unknowns absorbed. docs/math/uncertainty.md, Residuals.
#pragma once

#include <map>
#include <string>

#include "vispline/estimate/normal_equations.h"
#include "vispline/estimate/solve.h"

namespace vispline {

/// trace(J_s H^-1 J_s^T) over the rows of each sensor s, from sensor_fits(). All traces sum to the number of unknowns:
/// what the measurements do not have falls to the tracks, shared by their counts under the names of the cameras. Empty
/// without full rank.
std::map<std::string, double> absorbed_by_sensor(const Problem& problem, const Solution& solution,
                                                 const NormalEquations& equations, std::size_t threads);

}  // namespace vispline

/// The parameters of a solution as plain values with their sigmas, limits and correlations. docs/math/uncertainty.md.
#pragma once

#include "vispline/estimate/solve.h"
#include "vispline/results/calibration_result.h"

namespace vispline {

/// Fills parameters, fixed, correlation_labels, correlation and condition. `truth` may be null.
void report_parameters(const State& start, const Solution& solution, const State* truth, CalibrationResult& result);

}  // namespace vispline

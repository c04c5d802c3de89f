/// From a solution to a result that says how far it can be trusted. docs/math/uncertainty.md.
#pragma once

#include <optional>

#include "vispline/estimate/solve.h"
#include "vispline/results/calibration_result.h"

namespace vispline {

struct AssessOptions {
  std::size_t threads = 1;                      ///< does not change a byte of the result
  const State* start = nullptr;                 ///< what the user began with; null: the start of the problem
  const State* truth = nullptr;                 ///< rig, gravity and references, where somebody knows them
  std::optional<double> time_offset_bound_s{};  ///< a larger change of an offset counts as lost
  bool check_gradient = true;                   ///< two evaluations of the cost for each parameter
};

/// Never throws for numerical outcomes. Stages, knots, cpu_s and trajectory are left for the caller to fill.
CalibrationResult assess(const Problem& problem, const Solution& solution, const AssessOptions& options = {});

}  // namespace vispline

/// Sigmas that do not trust the noise to be white or of the assumed size: how far the estimate moves when one block of
/// time after the other is left out. docs/math/uncertainty.md, Jack-knife.
#pragma once

#include "vispline/estimate/solve.h"
#include "vispline/results/sigma_checks.h"

namespace vispline {

struct JackknifeOptions {
  int blocks = 10;
  std::size_t threads = 1;  ///< blocks at a time; does not change a byte of the result
  int max_iterations = 15;
};

/// `problem` must hold stretches without readings (smoothness_measurement()). Precondition: a solution with covariance.
Jackknife jackknife(const Problem& problem, const Solution& solution, const JackknifeOptions& options = {});

}  // namespace vispline

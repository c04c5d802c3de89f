/// The estimate as the truth of a simulation: the same rig on the same trajectory, the same stamps and points, noise
/// drawn anew, everything estimated again. docs/math/uncertainty.md, Twin.
#pragma once

#include <cstdint>

#include "vispline/estimate/solve.h"
#include "vispline/results/sigma_checks.h"

namespace vispline {

struct TwinOptions {
  int runs = 100;
  std::uint64_t seed = 1;
  std::size_t threads = 1;  ///< runs at a time; does not change a byte of the result
  int max_iterations = 20;
};

/// Noise of every reading and around every prior is normal with the assumed sigma; what only holds is left as it is.
/// Precondition: a solution with covariance.
Twin twin(const Problem& problem, const Solution& solution, const TwinOptions& options = {});

}  // namespace vispline

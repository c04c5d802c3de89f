/// Sigmas that do not trust the noise to be white or of the assumed size: how far single blocks of time pull the
/// estimate. docs/math/uncertainty.md, Jack-knife.
#pragma once

#include "vispline/estimate/solve.h"
#include "vispline/results/sigma_checks.h"

namespace vispline {

struct JackknifeOptions {
  int blocks = 10;
  std::size_t threads = 1;  ///< does not change a byte of the result
};

/// Infinitesimal (Jaeckel 1972): the weight of each block is changed, not its readings removed, because a curve that is
/// cut open measures biases and offsets much worse than the whole one. One linearisation and one solution for each
/// block. Precondition: a solution with covariance, whose weights the problem still has.
Jackknife jackknife(const Problem& problem, const Solution& solution, const JackknifeOptions& options = {});

}  // namespace vispline

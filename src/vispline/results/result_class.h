/// How far the result of a solver can be trusted: exactly one class, in file, document and exit code.
/// docs/math/uncertainty.md, Classes.
#pragma once

#include <string_view>

namespace vispline {

enum class ResultClass {
  kConverged,      ///< a tolerance met, gradient checked, full rank, residuals as their sigmas say
  kConvergedWeak,  ///< the same, but some parameter has a sigma above its limit: not observable
  kNotConverged,   ///< iteration or time limit, or the gradient check failed
  kRankDeficient,  ///< some direction of the unknowns is not measured at all
  kInconsistent,   ///< residuals far from their sigmas, or an offset at its bound
  kFailed,         ///< not finite, or no step lowers the cost
  kStopped,        ///< by the user; the best state so far
};

/// "converged", "converged-weak", "not-converged", "rank-deficient", "inconsistent", "failed", "stopped".
std::string_view to_name(ResultClass result_class);
/// What the process ends with: 0, 5 for a result that is not to be trusted, 130 when stopped.
int exit_code_of(ResultClass result_class);
/// Converged, weakly or not: the only classes whose values are written as a calibration.
bool is_trusted(ResultClass result_class);

}  // namespace vispline

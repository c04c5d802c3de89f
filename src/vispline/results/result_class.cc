#include "vispline/results/result_class.h"

#include "vispline/core/error.h"

namespace vispline {

std::string_view to_name(ResultClass result_class) {
  switch (result_class) {
    case ResultClass::kConverged:
      return "converged";
    case ResultClass::kConvergedWeak:
      return "converged-weak";
    case ResultClass::kNotConverged:
      return "not-converged";
    case ResultClass::kRankDeficient:
      return "rank-deficient";
    case ResultClass::kInconsistent:
      return "inconsistent";
    case ResultClass::kFailed:
      return "failed";
    case ResultClass::kStopped:
      return "stopped";
  }
  return "failed";
}

bool is_trusted(ResultClass result_class) {
  return result_class == ResultClass::kConverged || result_class == ResultClass::kConvergedWeak;
}

int exit_code_of(ResultClass result_class) {
  constexpr int kInterrupted = 130;
  if (is_trusted(result_class)) return static_cast<int>(ExitCode::kDone);
  return result_class == ResultClass::kStopped ? kInterrupted : static_cast<int>(ExitCode::kUntrusted);
}

}  // namespace vispline

/// What estimate and calibrate print and write, and what the process ends with.
#pragma once

#include "estimation_flags.h"
#include "exit_with.h"
#include "vispline/estimate/estimation.h"

namespace vispline::cli {

/// Assesses, compares with the truth, writes the folder, prints text or JSON; throws ExitWith unless the result can be
/// trusted.
void finish_estimation(EstimationFlags& flags, const Estimation& estimation, const RigDocument& start,
                       const std::string& spacing_reason);

}  // namespace vispline::cli

/// The whole loop on made-up data: a phone is simulated, its noise identified from a still piece, its rig calibrated
/// from a poor start, and everything compared with the truth.
#pragma once

#include <cstdint>

#include "vispline/allan/result.h"
#include "vispline/report/calibration_section.h"
#include "vispline/results/calibration_result.h"

namespace vispline::cli {

struct DemoLoop {
  AllanResult noise{};
  double still_s = 0.0;  ///< length of the still piece
  CalibrationResult calibration{};
  report::CalibrationCourse course{};
};

DemoLoop run_loop(std::uint64_t seed, std::size_t threads);

}  // namespace vispline::cli

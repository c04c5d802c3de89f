/// A calibration as JSON document and as tables for people. Keys and units: docs/json.md.
#pragma once

#include <string>

#include "vispline/results/calibration_result.h"
#include "vispline/results/json.h"

namespace vispline {

/// {"schema": "vispline.result/1", ...}. Values that are not observable are null, their sigmas are numbers.
std::string calibration_json(const CalibrationResult& result, const JsonContext& context);

/// Class with its reasons, then parameters, residuals, weak directions and stages; diagnostics are not in it.
std::string calibration_text(const CalibrationResult& result);

}  // namespace vispline

/// What a parameter file should say about the numbers in it, as comments of YAML.
#pragma once

#include <string>
#include <string_view>

#include "vispline/results/calibration_result.h"

namespace vispline {

/// "# class: converged" as the first line, reasons, then a line with the sigma of each estimated number whose
/// parameter begins with one of `sensors` ("cam0", ...; none: all). Text from outside cannot end a comment.
std::string calibration_comment(const CalibrationResult& result, const std::vector<std::string>& sensors = {});

}  // namespace vispline

/// What a calibration or noise file holds, after it was checked.
#pragma once

#include <optional>
#include <string>

#include "console.h"

namespace vispline::cli {

/// By its name (.yaml, .yml, .json) or its first line: is it to be checked as a parameter file? So is the folder of a
/// result.
bool is_calibration(const std::string& path);

/// Prints what it holds (docs/json.md, vispline.info_calibration/1). Throws as the readers of calibration/ do.
void print_calibration(const std::string& path, std::optional<double> rate_hz, Session& session);

}  // namespace vispline::cli

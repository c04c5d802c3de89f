/// Noise files of other tools, recognised by their content.
#pragma once

#include <string>
#include <string_view>

#include "vispline/calibration/noise_reading.h"

namespace vispline {

/// One of noise_dialects() by the keys that `file` holds. Throws E-CONFIG if none fits.
std::string noise_dialect_of(const YamlFile& file);

/// Throws what parse_yaml throws, and E-CONFIG (exit 2) for a key that is missing, misspelt, not a number, not
/// positive, and for a rate that is needed and not given. W-CONFIG: unknown keys, implausible figures, a missing random
/// walk.
NoiseReading parse_noise(std::string path, std::string_view text, const NoiseReadOptions& options = {});

NoiseReading read_noise_file(const std::string& path, const NoiseReadOptions& options = {});

}  // namespace vispline

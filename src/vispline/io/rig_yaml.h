/// Our own rig file: one YAML with everything. docs/formats.md, Rigs.
#pragma once

#include <string>

#include "vispline/calibration/yaml.h"
#include "vispline/core/error.h"
#include "vispline/io/rig_document.h"

namespace vispline::rig_yaml {

inline constexpr const char* kName = "vispline";

/// By the key vispline_rig.
bool recognizes(const YamlFile& file);
/// Throws E-CONFIG (exit 2) with place, key, unit wanted and nearest key; W-CONFIG for unknown keys.
RigDocument read(const YamlFile& file, Diagnostics& diagnostics);
/// Reads back to the same values.
std::string text(const RigDocument& document);

}  // namespace vispline::rig_yaml

/// Rigs by name, for simulations without a file. docs/formats.md, Rigs.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vispline/io/rig_document.h"

namespace vispline {

/// course, euroc-stereo, phone, gopro. Body x ahead, y left, z up; the cameras look along x, that of the course along
/// -x.
std::vector<std::string> rig_preset_names();
/// Empty if there is no preset of that name.
std::optional<RigDocument> rig_preset(std::string_view name);

}  // namespace vispline

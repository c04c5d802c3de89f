/// Pictures for walls, with detail at every scale: something to track from near and from far.
#pragma once

#include <cstdint>
#include <string>

#include "vispline/core/types.h"
#include "vispline/simulate/texture.h"

namespace vispline {

/// Soft clouds of several sizes under sharp-edged patches. A function of seed and name. Throws E-ARGUMENT for more than
/// 2^24 cells.
Texture wall_texture(const Vector2d& size_m, double cell_m, std::uint64_t seed, const std::string& name);

}  // namespace vispline

/// Averaging factors m, tau = m / rate, at which a curve is evaluated. docs/math/allan.md, Grids.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "vispline/allan/deviation.h"

namespace vispline {

/// "log" (about 5 factors an octave), "octave" (1, 2, 4), "decade" (1, 2, 4, 10, 20, 40), "all", or a number of
/// factors. Strictly increasing, from 1 to the largest for which a record of `readings` samples still holds `needed`
/// times as many averages as the deviation must have. Throws E-ARGUMENT (exit 2) for another word.
std::vector<std::int64_t> averaging_factors(std::string_view grid, std::int64_t readings, Deviation kind);

/// Factors per octave of the "log" grid.
inline constexpr int kFactorsPerOctave = 5;

/// The log grid up to `largest`: above kFactorsPerOctave octaves every factor is twice another one.
std::vector<std::int64_t> log_factors(std::int64_t largest);

}  // namespace vispline

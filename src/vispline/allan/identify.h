/// Which noise terms a spectrum holds, how large they are and how sure that is. docs/math/allan.md (20)-(24).
#pragma once

#include <span>
#include <vector>

#include "vispline/allan/result.h"
#include "vispline/allan/spectrum.h"

namespace vispline {

struct Identification {
  NoiseTerms terms;
  std::vector<ModelMisfit> misfits;
};

/// Maximum likelihood of non-negative Q^2, N^2, B^2, K^2 and of a ramp R over the cells, which are independent and
/// Gaussian. Of all sets of terms the one with the largest likelihood is kept after each term has paid kSignificance of
/// twice the log-likelihood; a random walk is preferred to flicker and ramp where they describe the record alike.
/// Intervals are those of the profile likelihood. Never fails; without cells nothing is resolved. `duration_s` of the
/// record, for the length that would resolve the rest.
Identification identify(std::span<const SpectralCell> cells, double rate_hz, double duration_s);

/// 99.99 % of a chi-square with one degree of freedom.
inline constexpr double kSignificance = 15.14;
}  // namespace vispline

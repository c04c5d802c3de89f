/// A curve with its intervals. docs/math/allan.md, Confidence of a curve.
#pragma once

#include "vispline/allan/curve_sums.h"
#include "vispline/allan/result.h"

namespace vispline {

/// The curve of sums pooled over segments of these lengths [readings]; the intervals are those of the mixture of the
/// resolved terms at each tau.
AllanCurve curve_by_terms(Deviation kind, const CurveSums& sums, std::span<const std::int64_t> lengths, double rate_hz,
                          const NoiseTerms& terms);

/// The same with intervals by one power law at each tau, identified from `longest_phase`, the phase of the longest
/// segment. A steeper noise fades for good: it never rules again at a longer tau.
AllanCurve curve_by_noise_type(Deviation kind, const CurveSums& sums, std::span<const std::int64_t> lengths,
                               double rate_hz, std::span<const double> longest_phase);

/// The smallest value of a curve.
MinimumDeviation minimum_of(const AllanCurve& curve);

}  // namespace vispline

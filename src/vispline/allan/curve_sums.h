/// Squared differences of a whole record, segment by segment, pooled.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "vispline/allan/deviation.h"
#include "vispline/allan/record.h"

namespace vispline {

/// The sums of one axis at a rate of 1 Hz: a factor and a sum each, factors increasing.
struct CurveSums {
  std::vector<std::int64_t> factors;
  std::vector<SquaredSum> sums;
};

/// Overlapping Allan sums of every axis at these factors; those of the log grid if the record is not held.
std::vector<CurveSums> overlapping_curves(const AllanRecord& record, std::span<const std::int64_t> factors,
                                          std::size_t threads);

/// Any deviation of one axis of a held record.
CurveSums curve_sums(const AllanRecord& record, std::size_t axis, Deviation kind,
                     std::span<const std::int64_t> factors);

/// The points at factors of `grid`, which is sorted.
CurveSums points_at(const CurveSums& curve, std::span<const std::int64_t> grid);

/// The overlapping Allan deviation at a rate of 1 Hz at each of `factors`, as far as the curve reaches: its own point
/// where it has one, else on the line between its neighbours in the logarithms.
std::vector<double> deviations_at(const CurveSums& curve, std::span<const std::int64_t> factors);

}  // namespace vispline

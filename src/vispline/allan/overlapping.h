/// The overlapping Allan sums of many averaging factors at once, in blocks that stay in the cache.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "vispline/allan/deviation.h"

namespace vispline {

/// Sum over k of (phase[k + 2 m] - 2 phase[k + m] + phase[k])^2 for each of the distinct factors m of each series:
/// result[series][factor]. All series have the same length. Exact: every start k counts. The same bytes for any number
/// of threads and any vector unit: eight running sums a block, blocks added in order. docs/math/allan.md (2), Speed.
std::vector<std::vector<SquaredSum>> overlapping_sums(std::span<const std::span<const double>> series,
                                                      std::span<const std::int64_t> factors, std::size_t threads);

/// The same sum over the starts phase[0 .. starts), which needs starts + 2 m points.
double second_difference_sum(const double* phase, std::size_t m, std::size_t starts);

}  // namespace vispline

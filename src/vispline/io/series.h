/// A column of numbers without stamps, such as the phase of a clock. docs/formats.md, Series.
#pragma once

#include <string>
#include <vector>

#include "vispline/io/read_options.h"
#include "vispline/io/read_result.h"

namespace vispline {

/// The numbers of a file with one column, or of the column that options.columns calls `value`, such as "-,value".
/// Comments, compression, decimal marks and malformed rows as in every table. The numbers stand at equal distances, so
/// a missing one (nan, inf, an empty cell) is not left out: it stays in its place as nan, W-NONFINITE, up to 1 %
/// (E-NONFINITE above). Throws Error with the codes of docs/formats.md; counts.read = counts.kept +
/// counts.dropped_total().
ReadResult<std::vector<double>> read_series(const std::string& path, const ReadOptions& options = {});

}  // namespace vispline

/// Checks of the stamps of a table, the same for every signal: which rows are kept, in which order, at which time.
/// docs/formats.md, Stamps.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "vispline/io/number_text.h"
#include "vispline/io/read_context.h"
#include "vispline/io/time_unit.h"

namespace vispline {

/// Rows of a table that are kept, with strictly increasing stamps.
struct StampedRows {
  std::vector<std::int64_t> ns;
  std::vector<std::size_t> row;  ///< as many, row of the table

  std::size_t size() const { return ns.size(); }
  /// Keeps the entries whose flag is not 0; as many flags as entries.
  void keep(const std::vector<std::uint8_t>& flags);
};

using SameRow = std::function<bool(std::size_t, std::size_t)>;

/// Exact stamps -> kept rows. Drops stamps out of range (W-/E-TIME-RANGE), isolated outliers (W-TIME-OUTLIER) and
/// duplicates (W-/E-DUPLICATE, E-TIME-PRECISION), sorts few late rows (W-/E-ORDER), refuses a clock that was set back
/// (E-TIME-RESET). `same(i, j)`: do two rows of the table hold the same values?
StampedRows check_stamps(ReadContext& context, const std::vector<Decimal>& stamps, const TimeUnit& unit,
                         const SameRow& same);

/// Median step between neighbours that differ, ns; 0 if there are none. At most 52 days, so that multiples of it fit.
std::int64_t median_step_ns(const std::vector<std::int64_t>& ns);

}  // namespace vispline

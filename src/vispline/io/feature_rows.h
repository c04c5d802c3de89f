/// What the readers of features share.
#pragma once

#include <cstdint>
#include <vector>

#include "vispline/io/row_stream.h"
#include "vispline/io/time_unit.h"

namespace vispline {

/// A whole number from 0 to 2^53, all that a double holds exactly. Throws E-CSV with the line.
std::uint64_t id_of(const ReadContext& context, double value, std::int64_t line);

/// The unit of the stamps: of the flag, of the header, else found from distinct stamps in order.
TimeUnit feature_time_unit(const ReadContext& context, const TextLayout& layout, const std::vector<Decimal>& stamps);

/// Throws E-ARGUMENT (exit 2) for flags that mean nothing here.
void require_feature_options(const ReadOptions& options);

}  // namespace vispline

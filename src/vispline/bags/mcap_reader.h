/// MCAP files with profile ros1 or ros2, or none; chunks none, lz4 and zstd.
#pragma once

#include <memory>

#include "vispline/bags/bag.h"
#include "vispline/bags/input.h"

namespace vispline {

bool is_mcap(const Input& input);

/// Throws E-UNSUPPORTED, E-CORRUPT, E-LIMIT. A file without a usable summary is scanned: W-UNINDEXED, W-TRUNCATED,
/// W-INDEX. Messages that a recorder compressed one by one with zstd are handed out decompressed.
std::unique_ptr<BagReader> open_mcap(Input input, const BagOptions& options);

}  // namespace vispline

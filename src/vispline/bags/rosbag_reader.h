/// rosbag v1, format 2.0, indexed or not; chunks none, bz2 and lz4.
#pragma once

#include <memory>

#include "vispline/bags/bag.h"
#include "vispline/bags/input.h"

namespace vispline {

bool is_rosbag(const Input& input);

/// Throws E-UNSUPPORTED (version, encryption), E-CORRUPT, E-LIMIT. A file that was not closed, is cut, or whose index
/// is wrong is scanned from front to end: W-UNINDEXED, W-TRUNCATED, W-INDEX.
std::unique_ptr<BagReader> open_rosbag(Input input, const BagOptions& options);

}  // namespace vispline

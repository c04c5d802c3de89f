/// Any recording of messages, found by its content.
#pragma once

#include <memory>
#include <string>

#include "vispline/bags/bag.h"
#include "vispline/bags/input.h"

namespace vispline {

/// A rosbag of any version, an MCAP file, a SQLite database, or a folder with a metadata.yaml or such files; never
/// throws.
bool is_bag(const std::string& path);

/// Throws E-OPEN, E-EMPTY, E-FORMAT, E-UNSUPPORTED, E-CORRUPT, E-DATABASE, E-PATH, E-LIMIT.
std::unique_ptr<BagReader> open_bag(const std::string& path, const BagOptions& options = {});
/// A rosbag or MCAP file that is open already.
std::unique_ptr<BagReader> open_bag(Input input, const BagOptions& options = {});

}  // namespace vispline

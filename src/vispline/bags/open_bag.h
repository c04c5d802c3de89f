/// Any recording of messages, found by its content.
#pragma once

#include <memory>
#include <string>

#include "vispline/bags/bag.h"
#include "vispline/bags/input.h"

namespace vispline {

/// A rosbag of any version; never throws.
bool is_bag(const std::string& path);

/// Throws E-OPEN, E-FORMAT, E-UNSUPPORTED, E-CORRUPT, E-LIMIT.
std::unique_ptr<BagReader> open_bag(const std::string& path, const BagOptions& options = {});
/// One file of a recording that is at hand already.
std::unique_ptr<BagReader> open_bag(Input input, const BagOptions& options = {});

}  // namespace vispline

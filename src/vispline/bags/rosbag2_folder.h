/// The folder of a rosbag2: metadata.yaml and one file or more, sqlite3 or MCAP, also as .zstd.
#pragma once

#include <memory>
#include <string>

#include "vispline/bags/bag.h"

namespace vispline {

/// Whether `path` is a folder with metadata.yaml, .db3 or .mcap files in it. Never throws.
bool is_rosbag2_folder(const std::string& path);

/// Files one after the other; topics of one name, type and encoding are one. A metadata.yaml that is absent or wrong is
/// W-METADATA, then all .db3 or .mcap files count. Throws E-PATH for a listed file that is absent or outside the
/// folder.
std::unique_ptr<BagReader> open_rosbag2_folder(const std::string& path, const BagOptions& options);

}  // namespace vispline

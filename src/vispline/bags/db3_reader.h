/// The sqlite3 files of rosbag2.
#pragma once

#include <memory>
#include <string>

#include "vispline/bags/bag.h"

namespace vispline {

/// One .db3 file; no metadata.yaml is needed. Throws E-OPEN, E-DATABASE, E-UNSUPPORTED, E-LIMIT; rows that are only in
/// a -wal file are read from a private copy: W-DATABASE. Messages that were compressed one by one are handed out
/// decompressed.
std::unique_ptr<BagReader> open_db3(const std::string& path, const BagOptions& options);
/// A whole database in memory.
std::unique_ptr<BagReader> open_db3_bytes(std::string bytes, std::string name, const BagOptions& options);

}  // namespace vispline

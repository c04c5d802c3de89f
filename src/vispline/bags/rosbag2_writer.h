/// The folder of a rosbag2 with one sqlite3 file and metadata.yaml, version 5.
#pragma once

#include <memory>

#include "vispline/bags/bag_writer.h"

namespace vispline {

/// metadata.yaml is written last: without it the recording is not complete.
std::unique_ptr<BagWriter> make_rosbag2_writer(const std::string& folder, const BagWriterOptions& options);

}  // namespace vispline

/// rosbag v1, format 2.0, chunked and indexed.
#pragma once

#include <memory>

#include "vispline/bags/bag_writer.h"

namespace vispline {

std::unique_ptr<BagWriter> make_rosbag_writer(const std::string& path, const BagWriterOptions& options);

}  // namespace vispline

/// MCAP, chunked, with message indexes, statistics and CRCs.
#pragma once

#include <memory>

#include "vispline/bags/bag_writer.h"

namespace vispline {

std::unique_ptr<BagWriter> make_mcap_writer(const std::string& path, const BagWriterOptions& options);

}  // namespace vispline

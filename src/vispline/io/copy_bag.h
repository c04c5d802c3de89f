/// A recording of messages into another container, message by message. docs/formats.md, Conversions.
#pragma once

#include <string>

#include "vispline/bags/bag_writer.h"
#include "vispline/io/read_options.h"
#include "vispline/io/text_lines.h"

namespace vispline {

struct CopyResult {
  ReadCounts counts;
  Diagnostics diagnostics;
};

/// In the order of the file, with the times of arrival; only options.topic if it is given (E-TOPIC). Messages keep
/// their bytes where the container takes their wire; Imu, poses, points and images go into that of the other ROS, and
/// every other type is left out (W-TYPE). Nothing has its final name if it throws.
CopyResult copy_recording(const std::string& from, const ReadOptions& options, Container container,
                          const std::string& to, const BagWriterOptions& writing, const ReadProgress& progress = {});

}  // namespace vispline

/// Recordings in the own form of a device, which are no text and no bag: cameras and autopilots. Adding one is a file
/// with kName, recognizes and stream, and one line in recorders.cc.
#pragma once

#include <optional>
#include <string>

#include "vispline/io/imu_stream.h"

namespace vispline {

/// Is the file one of these, by its first bytes or by options.format? False also if it cannot be opened.
bool is_recorder(const std::string& path, const ReadOptions& options = {});

/// As stream_imu. Precondition: is_recorder.
ImuStreamResult stream_recorder(const std::string& path, const ReadOptions& options, const ImuSink& sink,
                                const ImuStreamSettings& settings);

/// The names of the formats.
std::string recorder_names();

}  // namespace vispline

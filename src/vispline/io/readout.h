/// What a recording says about the rolling shutter of its camera: a first value for calibration, not a measurement.
#pragma once

#include <optional>
#include <string>

namespace vispline {

struct Readout {
  double seconds = 0.0;  ///< from the first row of a frame to the last
  std::string source;    ///< "SROT", "frame_readout_time", "Frame readout time[nanosec]"
};

/// Of a GoPro (MP4 or GPMF), a Gyroflow log, or movie_metadata.csv of the MARS logger (median over its frames). Empty
/// if `path` is another kind of file or says nothing. Throws as the readers do for a file that cannot be read.
std::optional<Readout> read_readout(const std::string& path);

}  // namespace vispline

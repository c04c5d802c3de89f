/// IMU samples of a file of any kind and length, block by block in constant memory. docs/formats.md, Long recordings.
#pragma once

#include <cstddef>
#include <string>

#include "vispline/core/error.h"
#include "vispline/io/imu_screen.h"
#include "vispline/io/read_options.h"
#include "vispline/io/text_lines.h"

namespace vispline {

struct ImuStreamSettings {
  ReadProgress progress = {};
  std::size_t block_bytes = std::size_t{1} << 20;  ///< taken from the file at a time
  std::size_t window_rows = kWindowRows;           ///< rows that may come late, see StampScreen
  bool whole_imu = false;                          ///< E-COLUMNS unless all six axes are there
};

struct ImuStreamResult {
  ReadCounts counts;
  Diagnostics diagnostics;
  std::string format;              ///< kName of the format that was read; of a recording the type of its messages
  ImuAxes axes;                    ///< that the file has; the others are nan in every sample
  std::size_t largest_window = 0;  ///< the most rows that were held at a time
  std::size_t largest_buffer = 0;  ///< the most bytes of text that were held at a time

  bool has_gyro() const { return axes.has_gyro(); }
  bool has_accel() const { return axes.has_accel(); }
};

/// Reads `path` once from front to end. The sink gets every sample that is kept; what needs the whole file is judged at
/// the end, so an error may come after all samples were handed on. Throws Error with the codes of docs/formats.md;
/// counts.read = counts.kept + counts.dropped_total() always. What sink and progress throw ends the reading.
ImuStreamResult stream_imu(const std::string& path, const ReadOptions& options, const ImuSink& sink,
                           const ImuStreamSettings& settings = {});

}  // namespace vispline

/// Features and points to text files, frame by frame. docs/formats.md, Features.
#pragma once

#include <string>

#include "vispline/files/output_file.h"
#include "vispline/io/features.h"

namespace vispline {

/// `#timestamp [ns],id,u [px],v [px]`. A frame without features leaves no row.
class TrackCsvWriter {
 public:
  explicit TrackCsvWriter(std::string path, OutputOptions options = {});
  void write(Time stamp, const std::vector<Feature>& features);
  /// The file has no name until then.
  void publish();

 private:
  void flush();
  OutputFile file_;
  std::string text_;
};

/// One row an image: stamp in seconds with nine decimals, then u,v of points 0 to `points` - 1, -1,-1 where a point was
/// not seen.
class CornerTableWriter {
 public:
  CornerTableWriter(std::string path, std::size_t points, OutputOptions options = {});
  /// Throws E-ARGUMENT for an id of `points` or more.
  void write(Time stamp, const std::vector<Feature>& features);
  void publish();

 private:
  OutputFile file_;
  std::size_t points_;
};

void write_tracks(const std::string& path, const FeatureSignal& features, OutputOptions options = {});
/// `#id,x [m],y [m],z [m]`
void write_points(const std::string& path, const PointMap& points, OutputOptions options = {});

}  // namespace vispline

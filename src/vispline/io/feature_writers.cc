#include "vispline/io/feature_writers.h"

#include "vispline/core/error.h"
#include "vispline/io/format_words.h"

namespace vispline {
namespace {
constexpr std::size_t kBlockBytes = std::size_t{1} << 19;
}

TrackCsvWriter::TrackCsvWriter(std::string path, OutputOptions options) : file_(std::move(path), options) {
  text_ = "#timestamp [ns],id,u [px],v [px]\n";
}

void TrackCsvWriter::write(Time stamp, const std::vector<Feature>& features) {
  for (const Feature& feature : features) {
    append_number(text_, to_ns(stamp));
    text_ += ',' + std::to_string(feature.id);
    append_cells(text_, ',', feature.px);
    text_ += '\n';
  }
  if (text_.size() >= kBlockBytes) flush();
}

void TrackCsvWriter::flush() {
  file_.write(text_);
  text_.clear();
}

void TrackCsvWriter::publish() {
  flush();
  file_.publish();
}

CornerTableWriter::CornerTableWriter(std::string path, std::size_t points, OutputOptions options)
    : file_(std::move(path), options), points_(points) {}

void CornerTableWriter::write(Time stamp, const std::vector<Feature>& features) {
  std::vector<Vector2d> corners(points_, Vector2d(-1.0, -1.0));
  for (const Feature& feature : features) {
    require(feature.id < points_, "ids below the number of points");
    corners[feature.id] = feature.px;
  }
  std::string row;
  append_seconds(row, stamp);
  for (const Vector2d& px : corners) append_cells(row, ',', px);
  file_.write(row + '\n');
}

void CornerTableWriter::publish() { file_.publish(); }

void write_tracks(const std::string& path, const FeatureSignal& features, OutputOptions options) {
  TrackCsvWriter writer(path, options);
  for (std::size_t i = 0; i < features.size(); ++i) writer.write(features.time[i], features.value[i]);
  writer.publish();
}

void write_points(const std::string& path, const PointMap& points, OutputOptions options) {
  std::string text = "#id,x [m],y [m],z [m]\n";
  for (const auto& [id, point] : points) {
    text += std::to_string(id);
    append_cells(text, ',', point);
    text += '\n';
  }
  write_file(path, text, options);
}

}  // namespace vispline

#include "vispline/estimate/track_columns.h"

#include <algorithm>

namespace vispline {
namespace {

void append(int first, int size, std::vector<int>& columns) {
  for (int i = 0; first >= 0 && i < size; ++i) columns.push_back(first + i);
}

}  // namespace

std::vector<int> camera_columns(const State& state, const Columns& columns, std::size_t camera) {
  const CameraColumns& first = columns.parameters.cameras[camera];
  std::vector<int> column;
  append(first.translation, 3, column);
  append(first.rotation, 3, column);
  append(first.intrinsics, static_cast<int>(state.rig.cameras[camera].lens.params.size()), column);
  append(first.time_offset, 1, column);
  append(first.line_delay, 1, column);
  return column;
}

TrackColumns::TrackColumns(const State& state, const Columns& columns, const Track& track) {
  const auto order = static_cast<std::size_t>(state.curve->order());
  view_knots_ = 6 * static_cast<Eigen::Index>(order);
  for (const Sighting& s : track.sightings) {
    first_.push_back(state.curve->first_knot({s.stamp, state.rig.cameras[s.camera].delay_s(s.px)}));
  }
  std::vector<std::size_t> firsts = first_, knots;
  std::sort(firsts.begin(), firsts.end());
  for (const std::size_t first : firsts) {
    for (std::size_t k = knots.empty() ? first : std::max(first, knots.back() + 1); k < first + order; ++k) {
      knots.push_back(k);
    }
  }
  for (const std::size_t k : knots) append(columns.layout.knot[k], 6, column_);
  std::vector<Place> cameras(state.rig.cameras.size(), {0, -1, 0});
  for (std::size_t i = 0; i < first_.size(); ++i) {
    Place& place = cameras[track.sightings[i].camera];
    if (place.camera < 0) {
      const std::vector<int> own = camera_columns(state, columns, track.sightings[i].camera);
      place = {0, size(), static_cast<Eigen::Index>(own.size())};
      column_.insert(column_.end(), own.begin(), own.end());
    }
    place.knot = 6 * (std::lower_bound(knots.begin(), knots.end(), first_[i]) - knots.begin());
    place_.push_back(place);
  }
}

std::vector<int> TrackColumns::columns_of(std::size_t sighting) const {
  const Place& place = place_[sighting];
  std::vector<int> columns(column_.begin() + place.knot, column_.begin() + place.knot + view_knots_);
  columns.insert(columns.end(), column_.begin() + place.camera, column_.begin() + place.camera + place.camera_size);
  return columns;
}

}  // namespace vispline

/// Which columns of the system a track depends on, and where each of its views has its own among them.
/// docs/math/estimate.md, Tracks.
#pragma once

#include <vector>

#include "vispline/estimate/track.h"
#include "vispline/estimate/view_rows.h"

namespace vispline {

/// Free columns of a camera, in the order of CameraColumns.
std::vector<int> camera_columns(const State& state, const Columns& columns, std::size_t camera);
/// How many of them come before the intrinsics.
inline int intrinsics_after(const CameraColumns& first) {
  return (first.translation < 0 ? 0 : 3) + (first.rotation < 0 ? 0 : 3);
}

/// Those of the knots in order, then those of the cameras. A view has a run of the one and a run of the other.
class TrackColumns {
 public:
  TrackColumns(const State& state, const Columns& columns, const Track& track);

  const std::vector<int>& column() const { return column_; }
  Eigen::Index size() const { return static_cast<Eigen::Index>(column_.size()); }
  std::size_t first_knot(std::size_t sighting) const { return first_[sighting]; }
  /// Columns of the system that a sighting has, in the order of its rows.
  std::vector<int> columns_of(std::size_t sighting) const;

  /// sum += J^T B in the rows that belong to the columns of a sighting.
  template <int kRows, class Factor, class Sum>
  void add(std::size_t sighting, const ViewRows<kRows>& J, const Factor& B, Sum& sum) const {
    sum.middleRows(place_[sighting].knot, J.knots).noalias() += J.knots_t().lazyProduct(B);
    sum.middleRows(place_[sighting].camera, J.size - J.knots).noalias() += J.camera_t().lazyProduct(B);
  }

 private:
  struct Place {
    Eigen::Index knot, camera, camera_size;  ///< in column()
  };
  std::vector<std::size_t> first_{};
  std::vector<Place> place_{};  ///< of each sighting
  Eigen::Index view_knots_ = 0;
  std::vector<int> column_{};
};

}  // namespace vispline

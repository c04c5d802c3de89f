#include "vispline/estimate/view_sums.h"

#include "vispline/estimate/track_columns.h"

namespace vispline {

ViewSums::ViewSums(const State& state, const Columns& columns)
    : knot_(columns.layout.knot), order_(state.curve->order()), H_(state.rig.cameras.size()) {
  for (std::size_t camera = 0; camera < H_.size(); ++camera) {
    camera_.push_back(camera_columns(state, columns, camera));
    H_[camera].resize(knot_.size());
  }
}

Eigen::MatrixXd& ViewSums::sum_of(std::size_t camera, std::size_t first_knot, Eigen::Index size) {
  Eigen::MatrixXd& H = H_[camera][first_knot];
  if (H.size() == 0) H.setZero(size, size);
  return H;
}

void ViewSums::add_to(Skyline& system) const {
  for (std::size_t camera = 0; camera < H_.size(); ++camera) {
    for (std::size_t first = 0; first < H_[camera].size(); ++first) {
      if (H_[camera][first].size() == 0) continue;
      std::vector<int> column;
      for (int i = 0; i < 6 * order_; ++i) column.push_back(knot_[first + static_cast<std::size_t>(i / 6)] + i % 6);
      column.insert(column.end(), camera_[camera].begin(), camera_[camera].end());
      system.add(column, H_[camera][first]);
    }
  }
}

}  // namespace vispline

/// J^T J of views, summed where they have the same columns: the same camera between the same knots. A system takes them
/// at once, instead of every view by itself. docs/math/estimate.md, Tracks.
#pragma once

#include <vector>

#include "vispline/estimate/skyline.h"
#include "vispline/estimate/view_rows.h"

namespace vispline {

class ViewSums {
 public:
  ViewSums(const State& state, const Columns& columns);

  /// A^T B for rows of one view of `camera`, from knot `first_knot` on: J^T J, or the symmetric J^T (S J).
  template <int kRows>
  void add(std::size_t camera, std::size_t first_knot, const ViewRows<kRows>& A, const ViewRows<kRows>& B);
  void add_to(Skyline& system) const;

 private:
  Eigen::MatrixXd& sum_of(std::size_t camera, std::size_t first_knot, Eigen::Index size);

  std::vector<int> knot_;
  int order_;
  std::vector<std::vector<int>> camera_;         ///< columns of each
  std::vector<std::vector<Eigen::MatrixXd>> H_;  ///< [camera][first knot]; empty where there is no view
};

template <int kRows>
void ViewSums::add(std::size_t camera, std::size_t first_knot, const ViewRows<kRows>& A, const ViewRows<kRows>& B) {
  Eigen::MatrixXd& H = sum_of(camera, first_knot, A.size);
  const auto n = static_cast<int>(A.size);
  tiles::add_symmetric_product({A.storage.data(), kMostViewColumns}, {B.storage.data(), kMostViewColumns}, n, kRows,
                               {H.data(), n});
}

}  // namespace vispline

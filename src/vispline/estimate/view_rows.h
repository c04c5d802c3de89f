/// Derivatives of what one view measures, by its knots and then by its camera. docs/math/estimate.md, Tracks.
#pragma once

#include "vispline/estimate/curve.h"
#include "vispline/estimate/measurement.h"
#include "vispline/estimate/reprojection.h"

namespace vispline {

inline constexpr int kMostViewColumns = 6 * kMaxOrder + 8 + kMaxLensParams;

/// Transposed: one row for each column of the system, so that what is summed over views runs along memory.
template <int kRows>
struct ViewRows {
  Eigen::Matrix<double, kMostViewColumns, kRows> storage;
  Eigen::Index knots = 0;  ///< rows of them
  Eigen::Index size = 0;

  auto J_t() const { return storage.topRows(size); }
  auto knots_t() const { return storage.topRows(knots); }
  auto camera_t() const { return storage.middleRows(knots, size - knots); }

  /// All zeros.
  void start(Eigen::Index knot_rows, Eigen::Index rows) {
    knots = knot_rows;
    size = rows;
    storage.topRows(size).setZero();
  }
  void set_knots(const KnotRows<kRows>& rows) {
    knots = size = rows.J.cols();
    storage.topRows(size) = rows.J.transpose();
  }
  /// By unknowns of the camera; nothing if they are fixed.
  template <class Block>
  void append(int column, const Block& block) {
    if (column < 0) return;
    storage.middleRows(size, block.cols()) = block.transpose();
    size += block.cols();
  }
};

}  // namespace vispline

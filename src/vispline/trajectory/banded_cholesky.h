/// Cholesky factorisation of a symmetric positive definite band matrix: linear in its size, as a spline's normal
/// equations ask for. Columns are updated in a fixed order, so the result is the same bytes everywhere.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace vispline {

class BandedCholesky {
 public:
  /// size: rows; bandwidth: number of sub-diagonals.
  BandedCholesky(Eigen::Index size, Eigen::Index bandwidth)
      : band_(Eigen::MatrixXd::Zero(bandwidth + 1, size)), bandwidth_(bandwidth) {}

  /// Entry (row, col) of the lower triangle, 0 <= row - col <= bandwidth, to be summed into before factorize().
  double& operator()(Eigen::Index row, Eigen::Index col) { return band_(row - col, col); }

  /// False if a pivot is not positive: the matrix is not positive definite to working precision.
  bool factorize() {
    for (Eigen::Index j = 0; j < band_.cols(); ++j) {
      if (!(band_(0, j) > 0.0)) return false;
      const Eigen::Index below = std::min(bandwidth_, band_.cols() - 1 - j);
      auto column = band_.col(j).head(below + 1);
      column /= std::sqrt(band_(0, j));
      for (Eigen::Index k = 1; k <= below; ++k) {
        band_.col(j + k).head(below + 1 - k) -= column(k) * column.segment(k, below + 1 - k);
      }
    }
    return true;
  }

  /// Precondition: factorize() returned true.
  Eigen::VectorXd solve(Eigen::VectorXd b) const {
    const Eigen::Index n = band_.cols();
    for (Eigen::Index j = 0; j < n; ++j) {
      const Eigen::Index below = std::min(bandwidth_, n - 1 - j);
      b(j) /= band_(0, j);
      b.segment(j + 1, below) -= b(j) * band_.col(j).segment(1, below);
    }
    for (Eigen::Index j = n; j-- > 0;) {
      const Eigen::Index below = std::min(bandwidth_, n - 1 - j);
      b(j) = (b(j) - band_.col(j).segment(1, below).dot(b.segment(j + 1, below))) / band_(0, j);
    }
    return b;
  }

 private:
  Eigen::MatrixXd band_;
  Eigen::Index bandwidth_;
};

}  // namespace vispline

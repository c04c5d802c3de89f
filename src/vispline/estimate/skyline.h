/// A symmetric positive definite system with a skyline, in square tiles: band, arrow and full matrices in one form.
/// docs/math/estimate.md, The linear system.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "vispline/estimate/tile_kernel.h"

namespace vispline {

/// The lower triangle. Row i of tiles is held from its first nonzero tile to the diagonal, and Cholesky's factor fills
/// no more than that: unknowns ordered by time make a band, unknowns at the end that meet all others make an arrow.
class Skyline {
 public:
  static constexpr int kTile = tiles::kTile;
  using Tile = Eigen::Matrix<double, kTile, kTile>;

  Skyline() = default;
  explicit Skyline(int size);

  int size() const { return size_; }
  int tiles() const { return static_cast<int>(first_.size()); }
  int first(int row) const { return first_[static_cast<std::size_t>(row)]; }
  Eigen::Map<Tile> tile(int row, int column);
  Eigen::Map<const Tile> tile(int row, int column) const;

  /// Makes place for the products of all `columns`; before allocate().
  void couple(std::span<const int> columns);
  /// Zeros in all the place that was asked for.
  void allocate();
  /// Adds H, of which the lower triangle counts, at the given rows and columns.
  void add(std::span<const int> columns, const Eigen::Ref<const Eigen::MatrixXd>& H);
  using Rows = Eigen::Ref<const Eigen::MatrixXd>;  ///< transposed: as many rows as columns of the system
  /// Adds A^T B at (a, b) and its transpose at (b, a).
  void add_products(std::span<const int> a, const Rows& A_t, std::span<const int> b, const Rows& B_t);
  Eigen::VectorXd diagonal() const;
  void add_to_diagonal(const Eigen::VectorXd& d);

  /// Cholesky in place; false if the matrix is not positive definite.
  bool factor();
  /// After factor(): X with H X = B.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B) const;
  /// After factor(): the last n rows and columns of the inverse, the covariance of the last n unknowns.
  Eigen::MatrixXd tail_of_inverse(int n) const;
  /// After factor(): the inverse of that, the last n rows and columns with all others absorbed.
  Eigen::MatrixXd tail_information(int n) const;

 private:
  friend class ProductPanel;
  /// Columns that follow each other inside one tile: what is added as a block.
  struct Run {
    int local, global, size;
  };
  static std::vector<Run> runs_of(std::span<const int> columns);
  Eigen::MatrixXd tail(int n) const;
  double* data(int row, int column) { return data_.data() + offset(row, column); }
  /// The part of a tile where two runs meet, the one of rows below.
  auto block(const Run& rows, const Run& columns) {
    return tile(rows.global / kTile, columns.global / kTile)
        .block(rows.global % kTile, columns.global % kTile, rows.size, columns.size);
  }
  /// The part of a tile where two runs meet, as its first entry.
  double* corner(const Run& rows, const Run& columns) {
    return data(rows.global / kTile, columns.global / kTile) + (columns.global % kTile) * kTile + rows.global % kTile;
  }
  /// Adds A^T B where two runs meet.
  void add_product(const Run& rows, const Rows& A_t, const Run& columns, const Rows& B_t);
  std::size_t offset(int row, int column) const {
    return (begin_[static_cast<std::size_t>(row)] + static_cast<std::size_t>(column - first(row))) * kTile * kTile;
  }

  int size_ = 0;
  std::vector<int> first_;
  std::vector<std::size_t> begin_;  ///< tiles before each row
  std::vector<double> data_;
};

/// Collects rows P, and subtracts P^T P from a system as soon as there are as many as a tile is high: what the
/// elimination of landmarks costs, in full matrix products.
class ProductPanel {
 public:
  explicit ProductPanel(Skyline& system);
  /// P^T, one row for each of `columns`; at most kTile columns at once.
  void add(std::span<const int> columns, const Eigen::Ref<const Eigen::MatrixXd>& P_t);
  void flush();

 private:
  Skyline& system_;
  std::vector<Skyline::Tile> tile_;  ///< P^T, one for each tile of columns
  std::vector<bool> touched_;
  int rows_ = 0;
};

}  // namespace vispline

#include "vispline/estimate/skyline.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <numeric>

namespace vispline {

Skyline::Skyline(int size) : size_(size), first_(static_cast<std::size_t>((size + kTile - 1) / kTile)) {
  std::iota(first_.begin(), first_.end(), 0);
}

Eigen::Map<Skyline::Tile> Skyline::tile(int row, int column) {
  return Eigen::Map<Tile>(data_.data() + offset(row, column));
}

Eigen::Map<const Skyline::Tile> Skyline::tile(int row, int column) const {
  return Eigen::Map<const Tile>(data_.data() + offset(row, column));
}

void Skyline::couple(std::span<const int> columns) {
  if (columns.empty()) return;
  const int least = *std::min_element(columns.begin(), columns.end()) / kTile;
  for (const int column : columns) {
    int& first = first_[static_cast<std::size_t>(column / kTile)];
    first = std::min(first, least);
  }
}

void Skyline::allocate() {
  begin_.assign(first_.size(), 0);
  std::size_t count = 0;
  for (int row = 0; row < tiles(); ++row) {
    begin_[static_cast<std::size_t>(row)] = count;
    count += static_cast<std::size_t>(row - first(row) + 1);
  }
  data_.assign(count * kTile * kTile, 0.0);
  for (int i = size_; i < tiles() * kTile; ++i) tile(i / kTile, i / kTile)(i % kTile, i % kTile) = 1.0;
}

std::vector<Skyline::Run> Skyline::runs_of(std::span<const int> columns) {
  std::vector<Run> runs;
  for (int i = 0; i < static_cast<int>(columns.size()); ++i) {
    const int column = columns[static_cast<std::size_t>(i)];
    if (!runs.empty() && column == runs.back().global + runs.back().size && column % kTile != 0) {
      ++runs.back().size;
    } else {
      runs.push_back({i, column, 1});
    }
  }
  return runs;
}

void Skyline::add(std::span<const int> columns, const Eigen::Ref<const Eigen::MatrixXd>& H) {
  const std::vector<Run> runs = runs_of(columns);
  for (std::size_t b = 0; b < runs.size(); ++b) {
    for (std::size_t a = b; a < runs.size(); ++a) {
      const auto part = H.block(runs[a].local, runs[b].local, runs[a].size, runs[b].size);
      if (runs[a].global >= runs[b].global) {
        block(runs[a], runs[b]) += part;
      } else {
        block(runs[b], runs[a]) += part.transpose();
      }
    }
  }
}

void Skyline::add_product(const Run& rows, const Rows& A_t, const Run& columns, const Rows& B_t) {
  const auto stride = [](const Rows& M) { return static_cast<int>(M.outerStride()); };
  tiles::add_product({A_t.data() + rows.local, stride(A_t)}, rows.size, {B_t.data() + columns.local, stride(B_t)},
                     columns.size, static_cast<int>(A_t.cols()), {corner(rows, columns), kTile});
}

void Skyline::add_products(std::span<const int> a, const Rows& A_t, std::span<const int> b, const Rows& B_t) {
  const std::vector<Run> a_runs = runs_of(a), b_runs = runs_of(b);
  for (const Run& run_b : b_runs) {
    for (const Run& run_a : a_runs) {
      const bool below = run_a.global >= run_b.global + run_b.size, above = run_a.global + run_a.size <= run_b.global;
      if (!above) add_product(run_a, A_t, run_b, B_t);
      if (!below) add_product(run_b, B_t, run_a, A_t);
    }
  }
}

Eigen::VectorXd Skyline::diagonal() const {
  Eigen::VectorXd d(size_);
  for (int i = 0; i < size_; ++i) d(i) = tile(i / kTile, i / kTile)(i % kTile, i % kTile);
  return d;
}

void Skyline::add_to_diagonal(const Eigen::VectorXd& d) {
  for (int i = 0; i < size_; ++i) tile(i / kTile, i / kTile)(i % kTile, i % kTile) += d(i);
}

bool Skyline::factor() {
  for (int i = 0; i < tiles(); ++i) {
    for (int j = first(i); j <= i; ++j) {
      for (int k = std::max(first(i), first(j)); k < j; ++k) {
        tiles::subtract_product(data(i, k), data(j, k), data(i, j));
      }
      if (j < i) {
        tiles::solve_transposed(data(j, j), data(i, j));
        continue;
      }
      auto L = tile(i, i);
      Tile D = L;
      const Eigen::LLT<Eigen::Ref<Tile>> cholesky(D);
      if (cholesky.info() != Eigen::Success) return false;
      L = D.triangularView<Eigen::Lower>();
    }
  }
  return true;
}

Eigen::MatrixXd Skyline::solve(const Eigen::MatrixXd& B) const {
  Eigen::MatrixXd X = Eigen::MatrixXd::Zero(tiles() * kTile, B.cols());
  X.topRows(size_) = B;
  const auto rows = [&](int tile) { return X.middleRows<kTile>(tile * kTile); };
  for (int i = 0; i < tiles(); ++i) {
    auto X_i = rows(i);
    for (int j = first(i); j < i; ++j) X_i.noalias() -= tile(i, j) * rows(j);
    tile(i, i).triangularView<Eigen::Lower>().solveInPlace(X_i);
  }
  for (int i = tiles() - 1; i >= 0; --i) {
    auto X_i = rows(i);
    tile(i, i).transpose().triangularView<Eigen::Upper>().solveInPlace(X_i);
    for (int j = first(i); j < i; ++j) rows(j).noalias() -= tile(i, j).transpose() * X_i;
  }
  return X.topRows(size_);
}

Eigen::MatrixXd Skyline::tail(int n) const {
  Eigen::MatrixXd L = Eigen::MatrixXd::Zero(n, n);
  const int begin = size_ - n;
  for (int column = begin; column < size_; ++column) {
    for (int row = column; row < size_; ++row) {
      if (column / kTile < first(row / kTile)) continue;
      L(row - begin, column - begin) = tile(row / kTile, column / kTile)(row % kTile, column % kTile);
    }
  }
  return L;
}

Eigen::MatrixXd Skyline::tail_of_inverse(int n) const {
  const Eigen::MatrixXd L_inverse = tail(n).triangularView<Eigen::Lower>().solve(Eigen::MatrixXd::Identity(n, n));
  return L_inverse.transpose() * L_inverse;
}

Eigen::MatrixXd Skyline::tail_information(int n) const {
  const Eigen::MatrixXd L = tail(n);
  return L * L.transpose();
}

ProductPanel::ProductPanel(Skyline& system)
    : system_(system),
      tile_(static_cast<std::size_t>(system.tiles()), Skyline::Tile::Zero()),
      touched_(static_cast<std::size_t>(system.tiles())) {}

void ProductPanel::add(std::span<const int> columns, const Eigen::Ref<const Eigen::MatrixXd>& P_t) {
  const auto rows = static_cast<int>(P_t.cols());
  if (rows_ + rows > Skyline::kTile) flush();
  for (const Skyline::Run& run : Skyline::runs_of(columns)) {
    const auto t = static_cast<std::size_t>(run.global / Skyline::kTile);
    touched_[t] = true;
    tile_[t].block(run.global % Skyline::kTile, rows_, run.size, rows) = P_t.middleRows(run.local, run.size);
  }
  rows_ += rows;
}

void ProductPanel::flush() {
  for (int i = 0; i < static_cast<int>(tile_.size()); ++i) {
    const auto row = static_cast<std::size_t>(i);
    if (!touched_[row]) continue;
    // Tiles that no landmark of the panel couples hold zeros here, and may have no place in the system.
    for (int j = system_.first(i); j <= i; ++j) {
      const auto column = static_cast<std::size_t>(j);
      if (touched_[column]) tiles::subtract_product(tile_[row].data(), tile_[column].data(), system_.data(i, j));
    }
  }
  for (std::size_t i = 0; i < tile_.size(); ++i) {
    if (touched_[i]) tile_[i].setZero();
    touched_[i] = false;
  }
  rows_ = 0;
}

}  // namespace vispline

/// Products of small dense matrices, column by column in memory: what the linear system spends its time in. Vector
/// units as wide as the machine has, the same bytes on all: every entry is summed in the same order, without fused
/// operations. docs/math/estimate.md, The linear system.
#pragma once

namespace vispline::tiles {

constexpr int kTile = 48;

/// C -= A B^T, tiles of 48 x 48.
void subtract_product(const double* A, const double* B, double* C);

/// X = X L^-T of tiles, L lower triangular.
void solve_transposed(const double* L, double* X);

/// Columns of doubles, `stride` apart.
template <class Double>
struct Columns {
  Double* data;
  int stride;
};

/// C += A B^T for A of rows x depth, B of columns x depth.
void add_product(Columns<const double> A, int rows, Columns<const double> B, int columns, int depth, Columns<double> C);

/// The lower triangle, and no less, of C += A B^T for a product that is symmetric.
void add_symmetric_product(Columns<const double> A, Columns<const double> B, int size, int depth, Columns<double> C);

}  // namespace vispline::tiles

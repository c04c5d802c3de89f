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

/// C += A A^T, A of n x m.
void add_gram(const double* A, int n, int m, double* C);

}  // namespace vispline::tiles

#include "vispline/estimate/tile_kernel.h"

// Sanitizers do not stand code that is chosen before the program starts.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define VISPLINE_VECTOR_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define VISPLINE_VECTOR_CLONES
#endif

namespace vispline::tiles {
namespace {

constexpr int kLanes = 8;
constexpr int kHigh = 2 * kLanes, kWide = 4;  // entries of C that stay in registers
static_assert(kTile % kHigh == 0 && kTile % kWide == 0);

/// Eight doubles anywhere in memory; the compiler splits them into what the machine has.
typedef double Lanes __attribute__((vector_size(8 * kLanes), aligned(8), may_alias));

}  // namespace

VISPLINE_VECTOR_CLONES void subtract_product(const double* A, const double* B, double* C) {
  for (int j = 0; j < kTile; j += kWide) {
    for (int i = 0; i < kTile; i += kHigh) {
      Lanes sum[kWide][2];
      for (int w = 0; w < kWide; ++w) {
        for (int h = 0; h < 2; ++h) sum[w][h] = *reinterpret_cast<const Lanes*>(C + (j + w) * kTile + i + h * kLanes);
      }
      for (int k = 0; k < kTile; ++k) {
        const double* a = A + k * kTile + i;
        const double* b = B + k * kTile + j;
        const Lanes a0 = *reinterpret_cast<const Lanes*>(a), a1 = *reinterpret_cast<const Lanes*>(a + kLanes);
        for (int w = 0; w < kWide; ++w) {
          sum[w][0] -= a0 * b[w];
          sum[w][1] -= a1 * b[w];
        }
      }
      for (int w = 0; w < kWide; ++w) {
        for (int h = 0; h < 2; ++h) *reinterpret_cast<Lanes*>(C + (j + w) * kTile + i + h * kLanes) = sum[w][h];
      }
    }
  }
}

VISPLINE_VECTOR_CLONES void solve_transposed(const double* L, double* X) {
  constexpr int kAll = kTile / kLanes;
  for (int j = 0; j < kTile; ++j) {
    Lanes* x = reinterpret_cast<Lanes*>(X + j * kTile);
    Lanes sum[kAll];
    for (int h = 0; h < kAll; ++h) sum[h] = x[h];
    for (int k = 0; k < j; ++k) {
      const Lanes* done = reinterpret_cast<const Lanes*>(X + k * kTile);
      for (int h = 0; h < kAll; ++h) sum[h] -= done[h] * L[k * kTile + j];
    }
    const double scale = 1.0 / L[j * kTile + j];
    for (int h = 0; h < kAll; ++h) x[h] = sum[h] * scale;
  }
}

VISPLINE_VECTOR_CLONES void add_gram(const double* A, int n, int m, double* C) {
  int i = 0;
  for (; i + kLanes <= n; i += kLanes) {
    int j = 0;
    for (; j + kWide <= n; j += kWide) {
      Lanes sum[kWide];
      for (int w = 0; w < kWide; ++w) sum[w] = *reinterpret_cast<const Lanes*>(C + (j + w) * n + i);
      for (int k = 0; k < m; ++k) {
        const Lanes a = *reinterpret_cast<const Lanes*>(A + k * n + i);
        for (int w = 0; w < kWide; ++w) sum[w] += a * A[k * n + j + w];
      }
      for (int w = 0; w < kWide; ++w) *reinterpret_cast<Lanes*>(C + (j + w) * n + i) = sum[w];
    }
    for (; j < n; ++j) {
      Lanes sum = *reinterpret_cast<const Lanes*>(C + j * n + i);
      for (int k = 0; k < m; ++k) sum += *reinterpret_cast<const Lanes*>(A + k * n + i) * A[k * n + j];
      *reinterpret_cast<Lanes*>(C + j * n + i) = sum;
    }
  }
  for (; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      double sum = C[j * n + i];
      for (int k = 0; k < m; ++k) sum += A[k * n + i] * A[k * n + j];
      C[j * n + i] = sum;
    }
  }
}

}  // namespace vispline::tiles

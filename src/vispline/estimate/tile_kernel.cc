#include "vispline/estimate/tile_kernel.h"

#include <algorithm>

namespace vispline::tiles {
namespace {

/// Doubles anywhere in memory that the machine works on at once.
template <int kLanes>
struct Vector;
template <>
struct Vector<2> {
  typedef double type __attribute__((vector_size(16), aligned(8), may_alias));
};
template <>
struct Vector<4> {
  typedef double type __attribute__((vector_size(32), aligned(8), may_alias));
};
template <>
struct Vector<8> {
  typedef double type __attribute__((vector_size(64), aligned(8), may_alias));
};

constexpr int kWide = 4;  // columns of C that stay in registers

template <int kLanes>
struct Kernel {
  using Lanes = typename Vector<kLanes>::type;
  static constexpr int kHigh = 2 * kLanes, kColumn = 6 * kLanes;
  static_assert(kTile % kColumn == 0 && kTile % kWide == 0);

  __attribute__((always_inline)) static inline Lanes& at(double* p) { return *reinterpret_cast<Lanes*>(p); }
  __attribute__((always_inline)) static inline const Lanes& at(const double* p) {
    return *reinterpret_cast<const Lanes*>(p);
  }

  __attribute__((always_inline)) static inline void subtract_product(const double* A, const double* B, double* C) {
    for (int j = 0; j < kTile; j += kWide) {
      for (int i = 0; i < kTile; i += kHigh) {
        Lanes low[kWide], high[kWide];
        for (int w = 0; w < kWide; ++w) {
          low[w] = at(C + (j + w) * kTile + i);
          high[w] = at(C + (j + w) * kTile + i + kLanes);
        }
        for (int k = 0; k < kTile; ++k) {
          const Lanes a = at(A + k * kTile + i), b = at(A + k * kTile + i + kLanes);
          for (int w = 0; w < kWide; ++w) {
            low[w] -= a * B[k * kTile + j + w];
            high[w] -= b * B[k * kTile + j + w];
          }
        }
        for (int w = 0; w < kWide; ++w) {
          at(C + (j + w) * kTile + i) = low[w];
          at(C + (j + w) * kTile + i + kLanes) = high[w];
        }
      }
    }
  }

  __attribute__((always_inline)) static inline void solve_transposed(const double* L, double* X) {
    for (int i = 0; i < kTile; i += kColumn) {
      for (int j = 0; j < kTile; ++j) {
        Lanes sum[6];
        for (int h = 0; h < 6; ++h) sum[h] = at(X + j * kTile + i + h * kLanes);
        for (int k = 0; k < j; ++k) {
          for (int h = 0; h < 6; ++h) sum[h] -= at(X + k * kTile + i + h * kLanes) * L[k * kTile + j];
        }
        const double scale = 1.0 / L[j * kTile + j];
        for (int h = 0; h < 6; ++h) at(X + j * kTile + i + h * kLanes) = sum[h] * scale;
      }
    }
  }

  __attribute__((always_inline)) static inline void add_product(Columns<const double> A, int rows,
                                                                Columns<const double> B, int columns, int depth,
                                                                Columns<double> C) {
    int i = 0;
    for (; i + kLanes <= rows; i += kLanes) {
      int j = 0;
      for (; j + kWide <= columns; j += kWide) {
        Lanes sum[kWide];
        for (int w = 0; w < kWide; ++w) sum[w] = at(C.data + (j + w) * C.stride + i);
        for (int k = 0; k < depth; ++k) {
          const Lanes a = at(A.data + k * A.stride + i);
          for (int w = 0; w < kWide; ++w) sum[w] += a * B.data[k * B.stride + j + w];
        }
        for (int w = 0; w < kWide; ++w) at(C.data + (j + w) * C.stride + i) = sum[w];
      }
      for (; j < columns; ++j) {
        Lanes sum = at(C.data + j * C.stride + i);
        for (int k = 0; k < depth; ++k) sum += at(A.data + k * A.stride + i) * B.data[k * B.stride + j];
        at(C.data + j * C.stride + i) = sum;
      }
    }
    for (; i < rows; ++i) {
      for (int j = 0; j < columns; ++j) {
        double sum = C.data[j * C.stride + i];
        for (int k = 0; k < depth; ++k) sum += A.data[k * A.stride + i] * B.data[k * B.stride + j];
        C.data[j * C.stride + i] = sum;
      }
    }
  }
};

/// The kernels for one kind of machine.
struct Level {
  void (*subtract_product)(const double*, const double*, double*);
  void (*solve_transposed)(const double*, double*);
  void (*add_product)(Columns<const double>, int, Columns<const double>, int, int, Columns<double>);
};

#define VISPLINE_LEVEL(name, lanes, attribute)                                                                  \
  attribute void subtract_product_##name(const double* A, const double* B, double* C) {                         \
    Kernel<lanes>::subtract_product(A, B, C);                                                                   \
  }                                                                                                             \
  attribute void solve_transposed_##name(const double* L, double* X) { Kernel<lanes>::solve_transposed(L, X); } \
  attribute void add_product_##name(Columns<const double> A, int rows, Columns<const double> B, int columns,    \
                                    int depth, Columns<double> C) {                                             \
    Kernel<lanes>::add_product(A, rows, B, columns, depth, C);                                                  \
  }                                                                                                             \
  constexpr Level k_##name{&subtract_product_##name, &solve_transposed_##name, &add_product_##name};

VISPLINE_LEVEL(base, 2, )
#ifdef __x86_64__
VISPLINE_LEVEL(avx2, 4, __attribute__((target("avx2"))))
VISPLINE_LEVEL(avx512, 8, __attribute__((target("avx512f,avx512vl,avx512dq"))))
#endif
#undef VISPLINE_LEVEL

const Level& level() {
#ifdef __x86_64__
  static const Level& widest = __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") ? k_avx512
                               : __builtin_cpu_supports("avx2")                                         ? k_avx2
                                                                                                        : k_base;
  return widest;
#else
  return k_base;
#endif
}

}  // namespace

void subtract_product(const double* A, const double* B, double* C) { level().subtract_product(A, B, C); }

void solve_transposed(const double* L, double* X) { level().solve_transposed(L, X); }

void add_product(Columns<const double> A, int rows, Columns<const double> B, int columns, int depth,
                 Columns<double> C) {
  level().add_product(A, rows, B, columns, depth, C);
}

void add_symmetric_product(Columns<const double> A, Columns<const double> B, int size, int depth, Columns<double> C) {
  constexpr int kStrip = 8;
  for (int begin = 0; begin < size; begin += kStrip) {
    add_product({A.data + begin, A.stride}, size - begin, {B.data + begin, B.stride}, std::min(kStrip, size - begin),
                depth, {C.data + begin * C.stride + begin, C.stride});
  }
}

}  // namespace vispline::tiles

#include "vispline/allan/overlapping.h"

#include <algorithm>
#include <cstring>

#include "vispline/core/parallel.h"

namespace vispline {
namespace {

/// Starts k per block. Three windows of it and the running sums fit the first-level cache.
constexpr std::size_t kBlock = 1024;
/// Blocks per chunk of work; a chunk is what one thread takes.
constexpr std::size_t kBlocksPerChunk = 64;

/// One register of AVX-512; one of AVX2, two of SSE2.
using Octo __attribute__((vector_size(64))) = double;
using Quad __attribute__((vector_size(32))) = double;

/// Eight running sums, whatever the width of the registers: the additions are the same.
template <class Vector>
inline __attribute__((always_inline)) double sum_in(const double* a, const double* b, const double* c, std::size_t n) {
  constexpr std::size_t kLanes = sizeof(Vector) / sizeof(double);
  Vector sums[8 / kLanes]{}, x, y, z;
  std::size_t k = 0;
  for (; k + 8 <= n; k += 8) {
    for (std::size_t part = 0; part < 8 / kLanes; ++part) {
      std::memcpy(&x, a + k + kLanes * part, sizeof x);
      std::memcpy(&y, b + k + kLanes * part, sizeof y);
      std::memcpy(&z, c + k + kLanes * part, sizeof z);
      const Vector d = (z - y) - (y - x);
      sums[part] += d * d;
    }
  }
  double lanes[8], sum = 0.0;
  std::memcpy(lanes, sums, sizeof lanes);
  for (std::size_t lane = 0; lane < 4; ++lane) sum += lanes[lane] + lanes[lane + 4];
  for (; k < n; ++k) {
    const double d = (c[k] - b[k]) - (b[k] - a[k]);
    sum += d * d;
  }
  return sum;
}

#if defined(__x86_64__) && defined(__GNUC__)
__attribute__((target("avx512f"))) double block_sum(const double* a, const double* b, const double* c, std::size_t n) {
  return sum_in<Octo>(a, b, c, n);
}
__attribute__((target("avx2"))) double block_sum(const double* a, const double* b, const double* c, std::size_t n) {
  return sum_in<Quad>(a, b, c, n);
}
__attribute__((target("default")))
#endif
double
block_sum(const double* a, const double* b, const double* c, std::size_t n) {
  return sum_in<Quad>(a, b, c, n);
}

/// Adds the sums of the starts [begin, end) for all factors; partial[i] belongs to factor i.
void add_chunk(std::span<const double> phase, std::span<const std::int64_t> factors, std::size_t begin, std::size_t end,
               std::span<double> partial) {
  for (std::size_t block = begin; block < end; block += kBlock) {
    for (std::size_t i = 0; i < factors.size(); ++i) {
      const auto m = static_cast<std::size_t>(factors[i]);
      if (block + 2 * m >= phase.size()) continue;
      const std::size_t n = std::min({kBlock, end - block, phase.size() - 2 * m - block});
      const double* start = phase.data() + block;
      partial[i] += block_sum(start, start + m, start + 2 * m, n);
    }
  }
}

}  // namespace

double second_difference_sum(const double* phase, std::size_t m, std::size_t starts) {
  return block_sum(phase, phase + m, phase + 2 * m, starts);
}

std::vector<std::vector<SquaredSum>> overlapping_sums(std::span<const std::span<const double>> series,
                                                      std::span<const std::int64_t> factors, std::size_t threads) {
  const std::size_t points = series.empty() ? 0 : series.front().size();
  const std::size_t chunk_size = kBlock * kBlocksPerChunk;
  const std::size_t chunks = (points + chunk_size - 1) / chunk_size;
  std::vector<std::vector<double>> partial(series.size() * chunks, std::vector<double>(factors.size(), 0.0));
  parallel_for(partial.size(), threads, [&](std::size_t task) {
    const std::size_t begin = (task % chunks) * chunk_size;
    add_chunk(series[task / chunks], factors, begin, std::min(begin + chunk_size, points), partial[task]);
  });
  std::vector<std::vector<SquaredSum>> sums(series.size(), std::vector<SquaredSum>(factors.size()));
  for (std::size_t task = 0; task < partial.size(); ++task) {
    for (std::size_t i = 0; i < factors.size(); ++i) sums[task / chunks][i].sum += partial[task][i];
  }
  for (auto& of_series : sums) {
    for (std::size_t i = 0; i < factors.size(); ++i) {
      of_series[i].count = std::max<std::int64_t>(0, static_cast<std::int64_t>(points) - 2 * factors[i]);
    }
  }
  return sums;
}

}  // namespace vispline

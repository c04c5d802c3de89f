#include "vispline/allan/overlapping.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>

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

/// Factors m, 2 m, 4 m, 8 m share their windows.
constexpr std::size_t kChain = 4;

/// Adds to sums[j] the squares of the n starts from `a` at factor 2^j m, j < length. Eight running sums a factor,
/// whatever the width of the registers: the additions are the same, and the same for every length.
template <class Vector, std::size_t length>
inline __attribute__((always_inline)) void add_squares_in(const double* a, std::size_t m, std::size_t n, double* sums) {
  constexpr std::size_t kLanes = sizeof(Vector) / sizeof(double), kParts = 8 / kLanes;
  Vector parts[length][kParts]{}, x, y, z;
  std::size_t k = 0;
  for (; k + 8 <= n; k += 8) {
    for (std::size_t part = 0; part < kParts; ++part) {
      const double* start = a + k + kLanes * part;
      std::memcpy(&x, start, sizeof x);
      std::memcpy(&y, start + m, sizeof y);
      for (std::size_t j = 0; j < length; ++j) {
        std::memcpy(&z, start + (2 * m << j), sizeof z);
        const Vector d = (z - y) - (y - x);
        parts[j][part] += d * d;
        y = z;
      }
    }
  }
  for (std::size_t j = 0; j < length; ++j) {
    double lanes[8], sum = 0.0;
    std::memcpy(lanes, parts[j], sizeof lanes);
    for (std::size_t lane = 0; lane < 4; ++lane) sum += lanes[lane] + lanes[lane + 4];
    const double *b = a + (m << j), *c = b + (m << j);
    for (std::size_t i = k; i < n; ++i) {
      const double d = (c[i] - b[i]) - (b[i] - a[i]);
      sum += d * d;
    }
    sums[j] += sum;
  }
}

/// `length` is 1 or kChain.
template <class Vector>
inline __attribute__((always_inline)) void add_squares_of(const double* a, std::size_t m, std::size_t n,
                                                          std::size_t length, double* sums) {
  if (length == kChain) {
    add_squares_in<Vector, kChain>(a, m, n, sums);
  } else {
    add_squares_in<Vector, 1>(a, m, n, sums);
  }
}

#if defined(__x86_64__) && defined(__GNUC__)
__attribute__((target("avx512f"))) void add_squares(const double* a, std::size_t m, std::size_t n, std::size_t length,
                                                    double* sums) {
  add_squares_of<Octo>(a, m, n, length, sums);
}
__attribute__((target("avx2"))) void add_squares(const double* a, std::size_t m, std::size_t n, std::size_t length,
                                                 double* sums) {
  add_squares_of<Quad>(a, m, n, length, sums);
}
__attribute__((target("default")))
#endif
void add_squares(const double* a, std::size_t m, std::size_t n, std::size_t length, double* sums) {
  add_squares_of<Quad>(a, m, n, length, sums);
}

/// Factors that are taken together: `length` of them, 1 or kChain, each twice the one before.
struct Chain {
  std::array<std::size_t, kChain> at{};  ///< positions in the list of factors
  std::size_t length = 1;
};

std::vector<Chain> chains_of(std::span<const std::int64_t> factors) {
  std::map<std::int64_t, std::size_t> left;
  for (std::size_t i = 0; i < factors.size(); ++i) left.emplace(factors[i], i);
  std::vector<Chain> chains;
  while (!left.empty()) {
    const std::int64_t m = left.begin()->first;
    Chain chain{{left.begin()->second}, 1};
    std::size_t length = 1;
    for (; length < kChain; ++length) {
      const auto next = left.find(m << length);
      if (next == left.end()) break;
      chain.at[length] = next->second;
    }
    if (length == kChain) chain.length = kChain;
    for (std::size_t j = 0; j < chain.length; ++j) left.erase(m << j);
    chains.push_back(chain);
  }
  return chains;
}

/// Adds the sums of the starts [begin, end) for all factors; partial[i] belongs to factor i.
void add_chunk(std::span<const double> phase, std::span<const std::int64_t> factors, std::span<const Chain> chains,
               std::size_t begin, std::size_t end, std::span<double> partial) {
  for (std::size_t block = begin; block < end; block += kBlock) {
    const std::size_t n = std::min(kBlock, end - block);
    const double* start = phase.data() + block;
    for (const Chain& chain : chains) {
      const auto first = static_cast<std::size_t>(factors[chain.at[0]]);
      double sums[kChain]{};
      if (block + n + (first << chain.length) <= phase.size()) {
        add_squares(start, first, n, chain.length, sums);
      } else {
        for (std::size_t j = 0; j < chain.length; ++j) {
          const std::size_t m = first << j;
          if (block + 2 * m < phase.size())
            add_squares(start, m, std::min(n, phase.size() - 2 * m - block), 1, sums + j);
        }
      }
      for (std::size_t j = 0; j < chain.length; ++j) partial[chain.at[j]] += sums[j];
    }
  }
}

}  // namespace

double second_difference_sum(const double* phase, std::size_t m, std::size_t starts) {
  double sum = 0.0;
  add_squares(phase, m, starts, 1, &sum);
  return sum;
}

std::vector<std::vector<SquaredSum>> overlapping_sums(std::span<const std::span<const double>> series,
                                                      std::span<const std::int64_t> factors, std::size_t threads) {
  const std::size_t points = series.empty() ? 0 : series.front().size();
  const std::vector<Chain> chains = chains_of(factors);
  const std::size_t chunk_size = kBlock * kBlocksPerChunk;
  const std::size_t chunks = (points + chunk_size - 1) / chunk_size;
  std::vector<std::vector<double>> partial(series.size() * chunks, std::vector<double>(factors.size(), 0.0));
  parallel_for(partial.size(), threads, [&](std::size_t task) {
    const std::size_t begin = (task % chunks) * chunk_size;
    add_chunk(series[task / chunks], factors, chains, begin, std::min(begin + chunk_size, points), partial[task]);
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

#include "vispline/core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

namespace vispline {
namespace {

TEST(Parallel, ThisMachineHasAThread) { EXPECT_GE(hardware_threads(), 1u); }

TEST(Parallel, EveryChunkRunsOnce) {
  for (const std::size_t threads : {0u, 1u, 2u, 3u, 16u}) {
    for (const std::size_t chunks : {0u, 1u, 2u, 7u, 1000u}) {
      std::vector<std::atomic<int>> calls(chunks);
      parallel_for(chunks, threads, [&](std::size_t chunk) { ++calls[chunk]; });
      for (std::size_t i = 0; i < chunks; ++i) EXPECT_EQ(calls[i], 1) << threads << " threads, chunk " << i;
    }
  }
}

TEST(Parallel, AnOrderedReductionHasTheSameBytesForAnyThreads) {
  const auto sum = [](std::size_t threads) {
    std::vector<double> part(101);
    parallel_for(part.size(), threads,
                 [&](std::size_t chunk) { part[chunk] = 1.0 / (3.0 + static_cast<double>(chunk)); });
    double total = 0.0;
    for (const double value : part) total += value;
    return total;
  };
  EXPECT_EQ(sum(1), sum(2));
  EXPECT_EQ(sum(1), sum(4));
}

TEST(Parallel, TheFirstFailureByChunkIsThrownAfterAllHaveRun) {
  for (const std::size_t threads : {1u, 4u}) {
    std::atomic<int> calls{0};
    try {
      parallel_for(20, threads, [&](std::size_t chunk) {
        ++calls;
        if (chunk % 5 == 3) throw std::runtime_error(std::to_string(chunk));
      });
      FAIL() << "did not throw";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "3");
    }
    EXPECT_EQ(calls, 20);
  }
}

}  // namespace
}  // namespace vispline

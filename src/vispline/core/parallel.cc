#include "vispline/core/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace vispline {

std::size_t hardware_threads() { return std::max(1u, std::thread::hardware_concurrency()); }

void parallel_for(std::size_t chunks, std::size_t threads, const std::function<void(std::size_t)>& work) {
  std::vector<std::exception_ptr> failure(chunks);
  std::atomic<std::size_t> next{0};
  const auto run = [&] {
    for (std::size_t chunk = next++; chunk < chunks; chunk = next++) {
      try {
        work(chunk);
      } catch (...) {
        failure[chunk] = std::current_exception();
      }
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (std::size_t i = 1; i < std::min(threads, chunks); ++i) helpers.emplace_back(run);
    run();
  }
  for (const std::exception_ptr& error : failure) {
    if (error) std::rethrow_exception(error);
  }
}

}  // namespace vispline

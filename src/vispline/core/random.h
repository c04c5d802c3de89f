/// Counter-based random numbers: a number is a function of (seed, stream, index), so any thread may draw any of them
/// and the bytes never depend on who did. Philox2x64-10: Salmon et al., "Parallel random numbers: as easy as 1, 2, 3",
/// SC 2011; normals by Box-Muller.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace vispline {

/// One independent stream of random numbers. Streams of one seed differ by their name and never overlap.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::string_view name);

  /// Two uniform numbers in (0, 1].
  std::array<double, 2> uniform_pair(std::uint64_t index) const;
  /// Two independent standard normal numbers.
  std::array<double, 2> normal_pair(std::uint64_t index) const;
  /// One standard normal number; consecutive indices 2i and 2i+1 share one call of the generator.
  double normal(std::uint64_t index) const { return normal_pair(index / 2)[index % 2]; }

 private:
  std::uint64_t key_;
  std::uint64_t stream_;
};

}  // namespace vispline

#include "vispline/core/random.h"

#include <Random123/philox.h>

#include <cmath>
#include <numbers>

namespace vispline {
namespace {

/// FNV-1a, so that the same name means the same stream on every platform.
std::uint64_t hash(std::string_view name) {
  std::uint64_t value = 0xcbf29ce484222325u;
  for (const unsigned char c : name) value = (value ^ c) * 0x100000001b3u;
  return value;
}

/// (0, 1], 53 bits: never 0, so that its logarithm is finite.
double to_unit(std::uint64_t bits) { return (static_cast<double>(bits >> 11) + 1.0) * 0x1p-53; }

}  // namespace

RandomStream::RandomStream(std::uint64_t seed, std::string_view name) : key_(seed), stream_(hash(name)) {}

std::array<double, 2> RandomStream::uniform_pair(std::uint64_t index) const {
  const r123::Philox2x64 generator;
  const auto bits = generator({{index, stream_}}, {{key_}});
  return {to_unit(bits[0]), to_unit(bits[1])};
}

std::array<double, 2> RandomStream::normal_pair(std::uint64_t index) const {
  const auto [u, v] = uniform_pair(index);
  const double radius = std::sqrt(-2.0 * std::log(u));
  const double angle = 2.0 * std::numbers::pi * v;
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace vispline

/// How much a reader takes from a stranger's file before it refuses with E-LIMIT. docs/formats.md, Limits.
#pragma once

#include <cstddef>
#include <cstdint>

namespace vispline::limits {

inline constexpr std::size_t kLineBytes = std::size_t{1} << 20;
inline constexpr std::size_t kFields = 4096;
/// Comments, header and the first rows of a table.
inline constexpr std::size_t kHeadBytes = std::size_t{8} << 20;
/// A compressed file may grow to kExpansion times its own size plus kExpansionBase bytes.
inline constexpr std::uint64_t kExpansion = 1000;
inline constexpr std::uint64_t kExpansionBase = std::uint64_t{1} << 30;
/// Memory of the xz decoder, which a file header can ask for.
inline constexpr std::uint64_t kDecoderBytes = std::uint64_t{256} << 20;

}  // namespace vispline::limits

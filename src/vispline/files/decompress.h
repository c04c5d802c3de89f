/// gzip and xz streams in memory, recognised by their first bytes, with a cap on what they may grow to.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace vispline {

enum class Compression { kNone, kGzip, kXz };

/// From the magic bytes, never from the name.
Compression compression_of(std::string_view bytes);

/// All (possibly concatenated) streams of `bytes`; at most about `enough` bytes of output are made, the rest is left
/// undone. Throws E-CORRUPT with the byte offset for damage or an early end, E-LIMIT (exit 7) above `cap` bytes or
/// limits::kDecoderBytes of memory. `path` is for messages only.
std::string decompress(const std::string& path, std::string_view bytes, Compression compression, std::uint64_t cap,
                       std::uint64_t enough = UINT64_MAX);

/// limits::kExpansion times `compressed` plus limits::kExpansionBase.
std::uint64_t expansion_cap(std::uint64_t compressed);

}  // namespace vispline

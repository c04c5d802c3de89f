/// A whole parameter file in memory: YAML, JSON or other short text.
#pragma once

#include <cstddef>
#include <string>

namespace vispline {

/// All bytes of `path`, opened read-only and never decompressed. Throws E-OPEN (exit 3) with the reason unless it is a
/// regular file that can be read, E-LIMIT (exit 7) above `cap` bytes, and E-FORMAT (exit 3) naming what was found if it
/// is not text.
std::string read_small_text_file(const std::string& path, std::size_t cap);

}  // namespace vispline

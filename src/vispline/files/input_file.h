/// The bytes of a measurement file: opened read-only, regular files only, decompressed if the content says so.
#pragma once

#include <cstdint>
#include <string>

namespace vispline {

/// The text of `path`, gzip and xz taken off, at most about `enough` bytes of it. Throws E-OPEN with the reason (exit
/// 3) unless it is a regular file that can be read, E-FORMAT naming what was found if it is not text, E-CORRUPT for a
/// damaged compressed stream and E-LIMIT (exit 7) for one that grows beyond the caps of limits.h.
std::string read_text_file(const std::string& path, std::uint64_t enough = UINT64_MAX);

}  // namespace vispline

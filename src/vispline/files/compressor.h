/// Bytes to a gzip or xz stream, block by block; the same bytes for the same input.
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace vispline {

class Compressor {
 public:
  virtual ~Compressor() = default;
  /// Appends compressed bytes to `out`; `last` ends the stream.
  virtual void compress(std::string_view in, bool last, std::string& out) = 0;
};

/// By the suffix .gz or .xz of a file name; null for any other.
std::unique_ptr<Compressor> compressor_for(std::string_view path);

}  // namespace vispline

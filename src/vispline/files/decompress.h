/// gzip and xz streams taken off piece by piece, recognised by their first bytes, with a cap on what they may grow to.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace vispline {

enum class Compression { kNone, kGzip, kXz };

/// From the magic bytes, never from the name.
Compression compression_of(std::string_view bytes);

/// Fills up to `room` bytes and says how many; 0: there are no more.
using BytePull = std::function<std::size_t(char* out, std::size_t room)>;

/// All (possibly concatenated) streams of a source, decompressed as they are asked for, in constant memory. Throws
/// E-CORRUPT with the byte offset for damage or an early end, E-LIMIT (exit 7) above `cap` bytes or
/// limits::kDecoderBytes of memory. `path` is for messages only.
class Decompressor {
 public:
  /// `block_bytes`: how much is pulled at a time.
  Decompressor(std::string path, Compression compression, BytePull pull, std::uint64_t cap,
               std::size_t block_bytes = std::size_t{1} << 16);
  ~Decompressor();
  Decompressor(Decompressor&&) noexcept;
  Decompressor& operator=(Decompressor&&) noexcept;

  /// Up to `room` bytes; 0 at the end of the last stream.
  std::size_t read(char* out, std::size_t room);

  class Codec;

 private:
  void refill();

  std::string path_;
  BytePull pull_;
  std::uint64_t cap_;
  std::unique_ptr<Codec> codec_;
  std::string block_;
  std::string_view in_;
  bool in_is_last_ = false;
  bool ended_ = false;
  std::uint64_t taken_ = 0;
  std::uint64_t made_ = 0;
};

/// The same for bytes in memory; at most about `enough` bytes of output are made, the rest is left undone.
std::string decompress(const std::string& path, std::string_view bytes, Compression compression, std::uint64_t cap,
                       std::uint64_t enough = UINT64_MAX);

/// limits::kExpansion times `compressed` plus limits::kExpansionBase.
std::uint64_t expansion_cap(std::uint64_t compressed);

}  // namespace vispline

/// The compressions of chunks and messages: bz2, lz4 (frame format), zstd. Streaming, with caps on what comes out.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "vispline/bags/byte_buffer.h"

namespace vispline {

enum class Codec { kNone, kBz2, kLz4, kZstd };

/// "" and "none", "bz2", "lz4", "zstd"; nothing for any other name.
std::optional<Codec> codec_named(std::string_view name);
std::string_view name_of(Codec codec);

inline constexpr std::uint64_t kChunkBytes = std::uint64_t{256} << 20;
/// A chunk may grow to this many times its stored size, or to kChunkRatioFrom bytes if that is more.
inline constexpr std::uint64_t kChunkRatio = 1000;
inline constexpr std::uint64_t kChunkRatioFrom = std::uint64_t{64} << 20;

/// What a chunk of `stored` bytes that claims to hold `size` may hold; empty message: it may.
std::string refusal(std::uint64_t stored, std::uint64_t size);
/// The most that `stored` compressed bytes may grow to.
std::uint64_t growth_cap(std::uint64_t stored);

/// One compressed stream, fed piece by piece. What came out before damage is good.
class Decoder {
 public:
  virtual ~Decoder() = default;
  /// Appends to `out`, which never grows beyond `cap` bytes. False: damage or more than `cap`, see error(). Bytes after
  /// the end of the stream are damage too.
  virtual bool feed(Bytes in, ByteBuffer& out, std::size_t cap) = 0;
  /// The stream has come to its end.
  bool finished() const { return finished_; }
  const std::string& error() const { return error_; }

 protected:
  bool fail(std::string why) {
    error_ = std::move(why);
    return false;
  }
  bool finished_ = false;
  std::string error_;
};

/// Never kNone.
std::unique_ptr<Decoder> make_decoder(Codec codec);

/// All of `in` at once. False and a reason in `error` for damage, an early end, or more than `cap` bytes.
bool decode(Codec codec, Bytes in, std::size_t cap, ByteBuffer& out, std::string& error);

/// One stream of `in`, the same bytes for the same input: bz2 level 9, lz4 and zstd at their default levels.
std::string encode(Codec codec, std::string_view in);

}  // namespace vispline

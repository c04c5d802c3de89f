#include "vispline/files/decompress.h"

#include <lzma.h>
#include <zlib.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "vispline/core/error.h"
#include "vispline/files/limits.h"

namespace vispline {
namespace {

constexpr std::size_t kBlockBytes = std::size_t{1} << 16;

[[noreturn]] void fail_corrupt(const std::string& path, std::uint64_t offset, const std::string& what) {
  throw Error(ExitCode::kInput, {.code = "E-CORRUPT",
                                 .message = what + " at byte " + std::to_string(offset),
                                 .where = path,
                                 .effect = "nothing read",
                                 .next = "copy or download the file again"});
}

[[noreturn]] void fail_limit(const std::string& path, const std::string& what) {
  throw Error(ExitCode::kLimit, {.code = "E-LIMIT",
                                 .message = what,
                                 .where = path,
                                 .effect = "nothing read",
                                 .next = "decompress the file by hand if you trust it"});
}

/// What a codec reports after one step.
enum class Step { kMore, kEnd, kDamaged, kMemory };

}  // namespace

class Decompressor::Codec {
 public:
  virtual ~Codec() = default;
  /// Takes bytes off the front of `in` and makes `made` bytes at `out`. `last`: nothing follows `in`.
  virtual Step step(std::string_view& in, bool last, char* out, std::size_t room, std::size_t& made) = 0;
};

namespace {

/// One zlib stream after another; zero padding between and after them is allowed, as gzip does.
class GzipCodec final : public Decompressor::Codec {
 public:
  GzipCodec() { require(inflateInit2(&stream_, 15 + 16) == Z_OK, "memory for a gzip stream"); }
  ~GzipCodec() override { inflateEnd(&stream_); }
  GzipCodec(const GzipCodec&) = delete;
  GzipCodec& operator=(const GzipCodec&) = delete;

  Step step(std::string_view& in, bool last, char* out, std::size_t room, std::size_t& made) override {
    if (between_members_ && !next_member(in)) return last ? Step::kEnd : Step::kMore;
    const std::size_t take = std::min<std::size_t>(in.size(), std::numeric_limits<uInt>::max());
    const std::size_t give = std::min<std::size_t>(room, std::numeric_limits<uInt>::max());
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(in.data()));
    stream_.avail_in = static_cast<uInt>(take);
    stream_.next_out = reinterpret_cast<Bytef*>(out);
    stream_.avail_out = static_cast<uInt>(give);
    const int code = inflate(&stream_, Z_NO_FLUSH);
    in.remove_prefix(take - stream_.avail_in);
    made = give - stream_.avail_out;
    if (code == Z_MEM_ERROR) return Step::kMemory;
    between_members_ = code == Z_STREAM_END;
    return code == Z_OK || between_members_ ? Step::kMore : Step::kDamaged;
  }

 private:
  bool next_member(std::string_view& in) {
    in.remove_prefix(std::min(in.find_first_not_of('\0'), in.size()));
    if (in.empty()) return false;
    inflateReset(&stream_);
    between_members_ = false;
    return true;
  }

  z_stream stream_{};
  bool between_members_ = false;
};

class XzCodec final : public Decompressor::Codec {
 public:
  XzCodec() : start_(lzma_stream_decoder(&stream_, limits::kDecoderBytes, LZMA_CONCATENATED)) {}
  ~XzCodec() override { lzma_end(&stream_); }
  XzCodec(const XzCodec&) = delete;
  XzCodec& operator=(const XzCodec&) = delete;

  Step step(std::string_view& in, bool last, char* out, std::size_t room, std::size_t& made) override {
    stream_.next_in = reinterpret_cast<const std::uint8_t*>(in.data());
    stream_.avail_in = in.size();
    stream_.next_out = reinterpret_cast<std::uint8_t*>(out);
    stream_.avail_out = room;
    const lzma_ret code = start_ == LZMA_OK ? lzma_code(&stream_, last ? LZMA_FINISH : LZMA_RUN) : start_;
    in.remove_prefix(in.size() - stream_.avail_in);
    made = room - stream_.avail_out;
    if (code == LZMA_STREAM_END) return Step::kEnd;
    if (code == LZMA_MEMLIMIT_ERROR || code == LZMA_MEM_ERROR) return Step::kMemory;
    return code == LZMA_OK ? Step::kMore : Step::kDamaged;
  }

 private:
  lzma_stream stream_ = LZMA_STREAM_INIT;
  lzma_ret start_;
};

std::unique_ptr<Decompressor::Codec> codec_for(Compression compression) {
  if (compression == Compression::kGzip) return std::make_unique<GzipCodec>();
  require(compression == Compression::kXz, "a compressed stream");
  return std::make_unique<XzCodec>();
}

}  // namespace

Decompressor::Decompressor(std::string path, Compression compression, BytePull pull, std::uint64_t cap,
                           std::size_t block_bytes)
    : path_(std::move(path)),
      pull_(std::move(pull)),
      cap_(cap),
      codec_(codec_for(compression)),
      block_(block_bytes, '\0') {}

Decompressor::~Decompressor() = default;
Decompressor::Decompressor(Decompressor&&) noexcept = default;
Decompressor& Decompressor::operator=(Decompressor&&) noexcept = default;

void Decompressor::refill() {
  const std::size_t got = pull_(block_.data(), block_.size());
  in_ = std::string_view(block_.data(), got);
  in_is_last_ = got == 0;
}

std::size_t Decompressor::read(char* out, std::size_t room) {
  while (!ended_ && room > 0) {
    if (in_.empty() && !in_is_last_) refill();
    const std::size_t before = in_.size();
    std::size_t made = 0;
    const Step step = codec_->step(in_, in_is_last_, out, room, made);
    taken_ += before - in_.size();
    made_ += made;
    if (made_ > cap_) fail_limit(path_, "decompresses to more than " + std::to_string(cap_) + " bytes");
    if (step == Step::kMemory) fail_limit(path_, "the compressed stream asks for too much memory");
    if (step == Step::kDamaged) fail_corrupt(path_, taken_, "the compressed stream is damaged or cut");
    ended_ = step == Step::kEnd;
    if (made > 0) return made;
  }
  return 0;
}

Compression compression_of(std::string_view bytes) {
  using namespace std::string_view_literals;
  if (bytes.starts_with("\x1f\x8b")) return Compression::kGzip;
  if (bytes.starts_with("\xfd"
                        "7zXZ\0"sv))
    return Compression::kXz;
  return Compression::kNone;
}

std::uint64_t expansion_cap(std::uint64_t compressed) {
  const std::uint64_t room = UINT64_MAX - limits::kExpansionBase;
  if (compressed > room / limits::kExpansion) return UINT64_MAX;
  return compressed * limits::kExpansion + limits::kExpansionBase;
}

std::string decompress(const std::string& path, std::string_view bytes, Compression compression, std::uint64_t cap,
                       std::uint64_t enough) {
  if (compression == Compression::kNone) return std::string(bytes.substr(0, enough));
  const auto pull = [&bytes](char* out, std::size_t room) {
    const std::size_t take = bytes.copy(out, room);
    bytes.remove_prefix(take);
    return take;
  };
  Decompressor stream(path, compression, pull, cap);
  std::string text, block(kBlockBytes, '\0');
  while (text.size() < enough) {
    const std::size_t made = stream.read(block.data(), block.size());
    if (made == 0) break;
    text.append(block, 0, made);
  }
  return text;
}

}  // namespace vispline

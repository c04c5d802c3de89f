#include "vispline/files/decompress.h"

#include <lzma.h>
#include <zlib.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

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

/// What a decoder reports after one step.
enum class Step { kMore, kStreamEnd, kDamaged, kMemory };

/// One zlib stream after another; zero padding after the last is allowed, as gzip does.
class GzipDecoder {
 public:
  explicit GzipDecoder(std::string_view in) : in_(in) { inflateInit2(&stream_, 15 + 16); }
  ~GzipDecoder() { inflateEnd(&stream_); }
  GzipDecoder(const GzipDecoder&) = delete;
  GzipDecoder& operator=(const GzipDecoder&) = delete;

  std::uint64_t offset() const { return pos_; }
  Step step(char* out, std::size_t room, std::size_t& made) {
    const std::size_t take = std::min<std::size_t>(in_.size() - pos_, std::numeric_limits<uInt>::max());
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(in_.data() + pos_));
    stream_.avail_in = static_cast<uInt>(take);
    stream_.next_out = reinterpret_cast<Bytef*>(out);
    stream_.avail_out = static_cast<uInt>(room);
    const int code = inflate(&stream_, Z_NO_FLUSH);
    pos_ += take - stream_.avail_in;
    made = room - stream_.avail_out;
    if (code == Z_STREAM_END) return next_member();
    if (code == Z_MEM_ERROR) return Step::kMemory;
    return code == Z_OK ? Step::kMore : Step::kDamaged;
  }

 private:
  Step next_member() {
    if (in_.find_first_not_of('\0', pos_) == std::string_view::npos) return Step::kStreamEnd;
    inflateReset(&stream_);
    return Step::kMore;
  }
  std::string_view in_;
  std::size_t pos_ = 0;
  z_stream stream_{};
};

class XzDecoder {
 public:
  explicit XzDecoder(std::string_view in) : size_(in.size()) {
    start_ = lzma_stream_decoder(&stream_, limits::kDecoderBytes, LZMA_CONCATENATED);
    stream_.next_in = reinterpret_cast<const std::uint8_t*>(in.data());
    stream_.avail_in = in.size();
  }
  ~XzDecoder() { lzma_end(&stream_); }
  XzDecoder(const XzDecoder&) = delete;
  XzDecoder& operator=(const XzDecoder&) = delete;

  std::uint64_t offset() const { return size_ - stream_.avail_in; }
  Step step(char* out, std::size_t room, std::size_t& made) {
    stream_.next_out = reinterpret_cast<std::uint8_t*>(out);
    stream_.avail_out = room;
    const lzma_ret code = start_ == LZMA_OK ? lzma_code(&stream_, LZMA_FINISH) : start_;
    made = room - stream_.avail_out;
    if (code == LZMA_STREAM_END) return Step::kStreamEnd;
    if (code == LZMA_MEMLIMIT_ERROR || code == LZMA_MEM_ERROR) return Step::kMemory;
    return code == LZMA_OK ? Step::kMore : Step::kDamaged;
  }

 private:
  std::size_t size_;
  lzma_ret start_;
  lzma_stream stream_ = LZMA_STREAM_INIT;
};

template <class Decoder>
std::string run(Decoder& decoder, const std::string& path, std::uint64_t cap, std::uint64_t enough) {
  std::string out;
  std::vector<char> block(kBlockBytes);
  while (out.size() < enough) {
    std::size_t made = 0;
    const Step step = decoder.step(block.data(), block.size(), made);
    if (out.size() + made > cap) fail_limit(path, "decompresses to more than " + std::to_string(cap) + " bytes");
    out.append(block.data(), made);
    if (step == Step::kStreamEnd) break;
    if (step == Step::kMemory) fail_limit(path, "the compressed stream asks for too much memory");
    if (step == Step::kDamaged) fail_corrupt(path, decoder.offset(), "the compressed stream is damaged or cut");
  }
  return out;
}

}  // namespace

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
  if (compression == Compression::kGzip) {
    GzipDecoder decoder(bytes);
    return run(decoder, path, cap, enough);
  }
  if (compression == Compression::kXz) {
    XzDecoder decoder(bytes);
    return run(decoder, path, cap, enough);
  }
  return std::string(bytes.substr(0, enough));
}

}  // namespace vispline

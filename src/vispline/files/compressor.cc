#include "vispline/files/compressor.h"

#include <lzma.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>

#include "vispline/core/error.h"

namespace vispline {
namespace {

constexpr int kXzPreset = 3;  // text tables gain little above it

class GzipCompressor final : public Compressor {
 public:
  GzipCompressor() {
    const int code = deflateInit2(&stream_, Z_DEFAULT_COMPRESSION, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY);
    require(code == Z_OK, "memory for a gzip stream");
  }
  ~GzipCompressor() override { deflateEnd(&stream_); }

  void compress(std::string_view in, bool last, std::string& out) override {
    do {
      const std::size_t take = std::min<std::size_t>(in.size(), std::numeric_limits<uInt>::max());
      stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(in.data()));
      stream_.avail_in = static_cast<uInt>(take);
      in.remove_prefix(take);
      drain(last && in.empty() ? Z_FINISH : Z_NO_FLUSH, out);
    } while (!in.empty());
  }

 private:
  void drain(int flush, std::string& out) {
    std::array<char, 65536> block;
    do {
      stream_.next_out = reinterpret_cast<Bytef*>(block.data());
      stream_.avail_out = static_cast<uInt>(block.size());
      deflate(&stream_, flush);
      out.append(block.data(), block.size() - stream_.avail_out);
    } while (stream_.avail_out == 0);
  }
  z_stream stream_{};
};

class XzCompressor final : public Compressor {
 public:
  XzCompressor() {
    require(lzma_easy_encoder(&stream_, kXzPreset, LZMA_CHECK_CRC64) == LZMA_OK, "memory for an xz stream");
  }
  ~XzCompressor() override { lzma_end(&stream_); }

  void compress(std::string_view in, bool last, std::string& out) override {
    std::array<std::uint8_t, 65536> block;
    stream_.next_in = reinterpret_cast<const std::uint8_t*>(in.data());
    stream_.avail_in = in.size();
    do {
      stream_.next_out = block.data();
      stream_.avail_out = block.size();
      const lzma_ret code = lzma_code(&stream_, last ? LZMA_FINISH : LZMA_RUN);
      require(code != LZMA_MEM_ERROR && code != LZMA_PROG_ERROR, "memory for an xz stream");
      out.append(reinterpret_cast<const char*>(block.data()), block.size() - stream_.avail_out);
    } while (stream_.avail_out == 0);
  }

 private:
  lzma_stream stream_ = LZMA_STREAM_INIT;
};

}  // namespace

std::unique_ptr<Compressor> compressor_for(std::string_view path) {
  if (path.ends_with(".gz")) return std::make_unique<GzipCompressor>();
  if (path.ends_with(".xz")) return std::make_unique<XzCompressor>();
  return nullptr;
}

}  // namespace vispline

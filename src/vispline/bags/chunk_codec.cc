#include "vispline/bags/chunk_codec.h"

#include <bzlib.h>
#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <utility>

#include "vispline/core/error.h"

namespace vispline {
namespace {

constexpr std::size_t kFirstRoom = std::size_t{1} << 20;

/// Makes room at the end of `out`, doubling up to `cap`; false if there is none left.
bool make_room(ByteBuffer& out, std::size_t cap) {
  if (out.size() >= cap) return false;
  if (out.room() == 0) out.reserve(std::min(cap, std::max(kFirstRoom, 2 * out.size())));
  return true;
}

std::size_t room_within(const ByteBuffer& out, std::size_t cap) { return std::min(out.room(), cap - out.size()); }

const char* kTooMuch = "it holds more than it claims";
const char* kRest = "bytes follow its end";

class Bz2Decoder final : public Decoder {
 public:
  Bz2Decoder() { ready_ = BZ2_bzDecompressInit(&stream_, 0, 0) == BZ_OK; }
  ~Bz2Decoder() override { BZ2_bzDecompressEnd(&stream_); }
  Bz2Decoder(const Bz2Decoder&) = delete;
  Bz2Decoder& operator=(const Bz2Decoder&) = delete;

  bool feed(Bytes in, ByteBuffer& out, std::size_t cap) override {
    if (!ready_) return fail("no memory for its decoder");
    stream_.next_in = const_cast<char*>(reinterpret_cast<const char*>(in.data()));
    stream_.avail_in = static_cast<unsigned>(in.size());
    while (stream_.avail_in > 0 || full_) {
      if (finished_) return stream_.avail_in == 0 || fail(kRest);
      std::byte probe{};  // one byte more than the cap tells a full chunk from one that goes on
      const bool room = make_room(out, cap);
      stream_.next_out = reinterpret_cast<char*>(room ? out.end() : &probe);
      const auto offered = static_cast<unsigned>(room ? room_within(out, cap) : 1);
      stream_.avail_out = offered;
      const int code = BZ2_bzDecompress(&stream_);
      if (room) out.commit(offered - stream_.avail_out);
      if (!room && stream_.avail_out == 0) return fail(kTooMuch);
      if (code != BZ_OK && code != BZ_STREAM_END) return fail("bz2 data is damaged");
      finished_ = code == BZ_STREAM_END;
      full_ = !finished_ && stream_.avail_out == 0;
    }
    return true;
  }

 private:
  bz_stream stream_{};
  bool ready_ = false;
  bool full_ = false;
};

class Lz4Decoder final : public Decoder {
 public:
  Lz4Decoder() { ready_ = LZ4F_isError(LZ4F_createDecompressionContext(&context_, LZ4F_VERSION)) == 0; }
  ~Lz4Decoder() override { LZ4F_freeDecompressionContext(context_); }
  Lz4Decoder(const Lz4Decoder&) = delete;
  Lz4Decoder& operator=(const Lz4Decoder&) = delete;

  bool feed(Bytes in, ByteBuffer& out, std::size_t cap) override {
    if (!ready_) return fail("no memory for its decoder");
    bool full = false;
    while (!in.empty() || full) {
      if (finished_) return in.empty() || fail(kRest);
      std::byte probe{};
      const bool room = make_room(out, cap);
      std::size_t made = room ? room_within(out, cap) : 1;
      const std::size_t offered = made;
      std::size_t taken = in.size();
      const std::size_t hint = LZ4F_decompress(context_, room ? out.end() : &probe, &made, in.data(), &taken, nullptr);
      if (LZ4F_isError(hint) != 0) return fail(std::string("lz4 data is damaged: ") + LZ4F_getErrorName(hint));
      if (room) out.commit(made);
      if (!room && made > 0) return fail(kTooMuch);
      in = in.subspan(taken);
      finished_ = hint == 0;
      full = !finished_ && made == offered;
      if (taken == 0 && made == 0) break;
    }
    return true;
  }

 private:
  LZ4F_dctx* context_ = nullptr;
  bool ready_ = false;
};

/// One idle zstd stream of each thread: a recording of messages that are compressed one by one needs millions, and
/// making one costs more than a message does.
class IdleStream {
 public:
  ~IdleStream() { ZSTD_freeDStream(stream_); }
  ZSTD_DStream* take() { return stream_ != nullptr ? std::exchange(stream_, nullptr) : ZSTD_createDStream(); }
  /// Kept unless it has grown large.
  void give(ZSTD_DStream* stream) {
    constexpr std::size_t kLargest = std::size_t{4} << 20;
    const bool keep = stream_ == nullptr && stream != nullptr && ZSTD_sizeof_DStream(stream) <= kLargest &&
                      ZSTD_isError(ZSTD_DCtx_reset(stream, ZSTD_reset_session_and_parameters)) == 0;
    if (!keep) return static_cast<void>(ZSTD_freeDStream(stream));
    stream_ = stream;
  }

 private:
  ZSTD_DStream* stream_ = nullptr;
};
thread_local IdleStream idle_stream;

class ZstdDecoder final : public Decoder {
 public:
  ZstdDecoder() : stream_(idle_stream.take()) {}
  ~ZstdDecoder() override { idle_stream.give(stream_); }
  ZstdDecoder(const ZstdDecoder&) = delete;
  ZstdDecoder& operator=(const ZstdDecoder&) = delete;

  bool feed(Bytes in, ByteBuffer& out, std::size_t cap) override {
    if (stream_ == nullptr) return fail("no memory for its decoder");
    ZSTD_inBuffer source{in.data(), in.size(), 0};
    bool full = false;
    while (source.pos < source.size || full) {
      finished_ = false;  // frames may follow each other
      std::byte probe{};
      const bool room = make_room(out, cap);
      ZSTD_outBuffer target{room ? out.end() : &probe, room ? room_within(out, cap) : 1, 0};
      const std::size_t before = source.pos;
      const std::size_t hint = ZSTD_decompressStream(stream_, &target, &source);
      if (ZSTD_isError(hint) != 0) return fail(std::string("zstd data is damaged: ") + ZSTD_getErrorName(hint));
      if (room) out.commit(target.pos);
      if (!room && target.pos > 0) return fail(kTooMuch);
      finished_ = hint == 0;
      full = !finished_ && target.pos == target.size;
      if (source.pos == before && target.pos == 0) break;
    }
    return true;
  }

 private:
  ZSTD_DStream* stream_;
};

std::string encode_bz2(std::string_view in) {
  auto size = static_cast<unsigned>(in.size() + in.size() / 100 + 600);
  std::string out(size, '\0');
  const int code = BZ2_bzBuffToBuffCompress(out.data(), &size, const_cast<char*>(in.data()),
                                            static_cast<unsigned>(in.size()), 9, 0, 0);
  require(code == BZ_OK, "memory to compress a chunk");
  out.resize(size);
  return out;
}

/// The only frames that ROS's own reader of rosbags takes (roslz4): blocks that stand alone, a checksum of the whole.
LZ4F_preferences_t frames_of_ros() {
  LZ4F_preferences_t preferences = LZ4F_INIT_PREFERENCES;
  preferences.frameInfo.blockSizeID = LZ4F_max64KB;
  preferences.frameInfo.blockMode = LZ4F_blockIndependent;
  preferences.frameInfo.contentChecksumFlag = LZ4F_contentChecksumEnabled;
  return preferences;
}

}  // namespace

std::optional<Codec> codec_named(std::string_view name) {
  if (name.empty() || name == "none") return Codec::kNone;
  if (name == "bz2") return Codec::kBz2;
  if (name == "lz4") return Codec::kLz4;
  if (name == "zstd") return Codec::kZstd;
  return std::nullopt;
}

std::string_view name_of(Codec codec) {
  switch (codec) {
    case Codec::kBz2:
      return "bz2";
    case Codec::kLz4:
      return "lz4";
    case Codec::kZstd:
      return "zstd";
    case Codec::kNone:
      break;
  }
  return "none";
}

std::uint64_t growth_cap(std::uint64_t stored) {
  const std::uint64_t ratio = stored > kChunkBytes / kChunkRatio ? kChunkBytes : stored * kChunkRatio;
  return std::min(kChunkBytes, std::max(ratio, kChunkRatioFrom));
}

std::string refusal(std::uint64_t stored, std::uint64_t size) {
  if (size <= growth_cap(stored)) return "";
  return "it claims " + std::to_string(size) + " bytes from " + std::to_string(stored) +
         "; at most 256 MiB and 1000 times its size (or 64 MiB) are taken";
}

std::unique_ptr<Decoder> make_decoder(Codec codec) {
  require(codec != Codec::kNone, "a compression");
  if (codec == Codec::kBz2) return std::make_unique<Bz2Decoder>();
  if (codec == Codec::kLz4) return std::make_unique<Lz4Decoder>();
  return std::make_unique<ZstdDecoder>();
}

bool decode(Codec codec, Bytes in, std::size_t cap, ByteBuffer& out, std::string& error) {
  const auto decoder = make_decoder(codec);
  const bool good = decoder->feed(in, out, cap);
  error = good && !decoder->finished() ? "it ends early" : decoder->error();
  return good && decoder->finished();
}

std::string encode(Codec codec, std::string_view in) {
  if (codec == Codec::kNone) return std::string(in);
  if (codec == Codec::kBz2) return encode_bz2(in);
  const bool zstd = codec == Codec::kZstd;
  const LZ4F_preferences_t ros = frames_of_ros();
  std::string out(zstd ? ZSTD_compressBound(in.size()) : LZ4F_compressFrameBound(in.size(), &ros), '\0');
  const std::size_t size = zstd ? ZSTD_compress(out.data(), out.size(), in.data(), in.size(), ZSTD_CLEVEL_DEFAULT)
                                : LZ4F_compressFrame(out.data(), out.size(), in.data(), in.size(), &ros);
  require((zstd ? ZSTD_isError(size) : LZ4F_isError(size)) == 0, "memory to compress a chunk");
  out.resize(size);
  return out;
}

}  // namespace vispline

#include "vispline/bags/chunk_codec.h"

#include <gtest/gtest.h>

#include "vispline/core/random.h"

namespace vispline {
namespace {

constexpr Codec kAll[] = {Codec::kBz2, Codec::kLz4, Codec::kZstd};

std::string some_text(std::size_t size) {
  const RandomStream stream(3, "chunk");
  std::string text;
  for (std::uint64_t i = 0; text.size() < size; ++i) text += std::to_string(stream.normal(i));
  text.resize(size);
  return text;
}

/// The whole stream in pieces of `piece` bytes.
std::string decoded(Codec codec, const std::string& packed, std::size_t piece, std::size_t cap, std::string& error) {
  ByteBuffer out;
  const auto decoder = make_decoder(codec);
  for (std::size_t pos = 0; pos < packed.size(); pos += piece) {
    if (!decoder->feed(as_bytes(std::string_view(packed).substr(pos, piece)), out, cap)) break;
  }
  error = decoder->error();
  EXPECT_LE(out.size(), cap);
  return std::string(as_text(out.view()));
}

TEST(ChunkCodec, DecodesWhatItEncodes) {
  for (const Codec codec : kAll) {
    for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{1000}, std::size_t{1'100'000}}) {
      const std::string text = some_text(size), packed = encode(codec, text);
      for (const std::size_t piece : {std::size_t{777}, packed.size()}) {
        std::string error;
        EXPECT_EQ(decoded(codec, packed, piece, size, error), text) << name_of(codec) << " " << size;
        EXPECT_EQ(error, "");
      }
      ByteBuffer out;
      std::string error;
      EXPECT_TRUE(decode(codec, as_bytes(packed), size, out, error)) << name_of(codec) << " " << size << error;
    }
  }
}

TEST(ChunkCodec, StopsAtTheCap) {
  const std::string text(5'000'000, 'x');
  for (const Codec codec : kAll) {
    const std::string packed = encode(codec, text);
    for (const std::size_t cap : {std::size_t{0}, std::size_t{10}, text.size() - 1}) {
      std::string error;
      const std::string got = decoded(codec, packed, 100, cap, error);
      EXPECT_NE(error, "") << name_of(codec) << " " << cap;
      EXPECT_EQ(got, text.substr(0, got.size()));
    }
  }
}

TEST(ChunkCodec, CutAndDamagedStreams) {
  const std::string text = some_text(200'000);
  for (const Codec codec : kAll) {
    const std::string packed = encode(codec, text);
    std::string damaged = packed;
    for (std::size_t i = packed.size() / 2; i < packed.size() / 2 + 64; ++i)
      damaged[i] = static_cast<char>(~damaged[i]);
    ByteBuffer cut, hurt, longer;
    std::string error;
    EXPECT_FALSE(
        decode(codec, as_bytes(std::string_view(packed).substr(0, packed.size() - 1)), text.size(), cut, error));
    EXPECT_FALSE(decode(codec, as_bytes(packed + "abcd"), text.size(), longer, error));
    const bool good = decode(codec, as_bytes(damaged), text.size(), hurt, error);
    EXPECT_TRUE(!good || codec == Codec::kLz4 || codec == Codec::kZstd) << name_of(codec);  // those carry no checksum
    EXPECT_TRUE(!good || as_text(hurt.view()) != text);
  }
}

TEST(ChunkCodec, Names) {
  EXPECT_EQ(codec_named(""), Codec::kNone);
  for (const Codec codec : {Codec::kNone, Codec::kBz2, Codec::kLz4, Codec::kZstd}) {
    EXPECT_EQ(codec_named(name_of(codec)), codec);
  }
  EXPECT_FALSE(codec_named("xz"));
}

TEST(ChunkCodec, CapsOnClaims) {
  EXPECT_EQ(refusal(100, kChunkRatioFrom), "");
  EXPECT_NE(refusal(100, kChunkRatioFrom + 1), "");
  EXPECT_EQ(refusal(1 << 20, kChunkBytes), "");
  EXPECT_NE(refusal(UINT64_MAX, kChunkBytes + 1), "");
  EXPECT_EQ(refusal(70'000, 70'000'000), "");
  EXPECT_NE(refusal(70'000, 70'000'001), "");
}

// roslz4 takes no other: version 1, blocks that stand alone, a checksum of the whole, no size; blocks up to 64 KiB.
TEST(ChunkCodec, Lz4FramesThatRosReads) {
  const std::string frame = encode(Codec::kLz4, std::string(3'000'000, 'x'));
  EXPECT_EQ(frame.substr(0, 6), "\x04\x22\x4d\x18\x64\x40");
}

}  // namespace
}  // namespace vispline

#include "check_bag.h"
#include "vispline/bags/chunk_codec.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vispline;
  if (size < 2) return 0;
  constexpr Codec kCodecs[] = {Codec::kBz2, Codec::kLz4, Codec::kZstd};
  const Codec codec = kCodecs[data[0] % 3];
  const std::size_t cap = std::size_t{data[1]} * 4096, piece = 1 + data[1] % 17;
  const Bytes stream = std::as_bytes(std::span(data + 2, size - 2));
  ByteBuffer whole, pieces;
  std::string error;
  const bool good = decode(codec, stream, cap, whole, error);
  fuzz::must(whole.size() <= cap && good == error.empty());
  const auto decoder = make_decoder(codec);
  bool fed = true;
  for (std::size_t at = 0; at < stream.size() && fed; at += piece) {
    fed = decoder->feed(stream.subspan(at, std::min(piece, stream.size() - at)), pieces, cap);
  }
  fuzz::must(pieces.size() <= cap);
  if (good) fuzz::must(fed && decoder->finished() && as_text(pieces.view()) == as_text(whole.view()));
  return 0;
}

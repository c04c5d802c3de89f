#include "vispline/bags/mcap_chunk.h"

#include <algorithm>

namespace vispline::mcap {
namespace {

constexpr std::size_t kDecodePiece = std::size_t{1} << 18;

}  // namespace

Bytes ChunkDecoder::decode(Window& window, const ChunkHead& head, Codec codec, std::uint64_t stored, bool cut,
                           std::string& why) {
  Bytes bytes;
  if (codec == Codec::kNone) {
    bytes = window.view(head.data_offset, static_cast<std::size_t>(std::min(stored, kChunkBytes)));
  } else {
    why = decode_stream(window, head, codec, stored, cut);
    bytes = decoded_.view();
  }
  if (cut) {
    why.clear();
  } else if (why.empty() && bytes.size() != head.size) {
    why = "it holds another size than it claims";
  } else if (why.empty() && head.crc != 0 && crc32_of(bytes) != head.crc) {
    why = "its CRC differs";
  }
  return bytes;
}

std::string ChunkDecoder::decode_stream(Window& window, const ChunkHead& head, Codec codec, std::uint64_t stored,
                                        bool cut) {
  const auto cap = static_cast<std::size_t>(std::min(head.size, growth_cap(stored)));
  decoded_.clear();
  const auto decoder = make_decoder(codec);
  for (std::uint64_t done = 0; done < stored;) {
    const auto piece = static_cast<std::size_t>(std::min<std::uint64_t>(kDecodePiece, stored - done));
    const Bytes in = window.view(head.data_offset + done, piece);
    if (in.empty()) break;
    if (!decoder->feed(in, decoded_, cap)) return decoder->error();
    done += in.size();
  }
  return decoder->finished() || cut || head.size == 0 ? "" : "it ends early";
}

}  // namespace vispline::mcap

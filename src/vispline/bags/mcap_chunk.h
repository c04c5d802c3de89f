/// The records of a chunk of an MCAP file, decompressed.
#pragma once

#include <string>

#include "vispline/bags/byte_buffer.h"
#include "vispline/bags/chunk_codec.h"
#include "vispline/bags/mcap_records.h"

namespace vispline::mcap {

class ChunkDecoder {
 public:
  /// `stored` bytes of the chunk are there; `cut`: the file ends in it, so what can be had counts. `why` says what is
  /// wrong with a whole chunk: it cannot be decompressed, has another size than it claims, or another CRC; empty if
  /// nothing is. The bytes are good until the next call, or the next view of `window`.
  Bytes decode(Window& window, const ChunkHead& head, Codec codec, std::uint64_t stored, bool cut, std::string& why);

 private:
  std::string decode_stream(Window& window, const ChunkHead& head, Codec codec, std::uint64_t stored, bool cut);

  ByteBuffer decoded_;
};

}  // namespace vispline::mcap

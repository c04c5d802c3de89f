/// Messages of a rosbag2 that were compressed one by one.
#pragma once

#include "vispline/bags/chunk_codec.h"

namespace vispline {

/// CDR begins with a zero byte, a zstd frame never does.
inline bool is_zstd_frame(Bytes bytes) {
  return bytes.size() >= 4 && load_le<std::uint32_t>(bytes.data()) == 0xfd2fb528u;
}

/// The message in `bytes`; with `error` set, nothing. The result is good until `buffer` changes.
inline Bytes plain_message(Bytes bytes, ByteBuffer& buffer, std::string& error) {
  error.clear();
  if (!is_zstd_frame(bytes)) return bytes;
  buffer.clear();
  return decode(Codec::kZstd, bytes, static_cast<std::size_t>(growth_cap(bytes.size())), buffer, error) ? buffer.view()
                                                                                                        : Bytes{};
}

}  // namespace vispline

/// The records of an MCAP file: u8 kind, u64 length, content. Strings and maps carry a u32 length in bytes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "vispline/bags/bag.h"
#include "vispline/bags/input.h"

namespace vispline::mcap {

inline constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};
inline constexpr std::size_t kRecordHead = 9;
inline constexpr std::uint64_t kFooterBytes = 20;  ///< content of the last record

enum Op : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0b,
  kSummaryOffset = 0x0e,
  kDataEnd = 0x0f,
};

struct Record {
  std::uint64_t offset = 0, content = 0, bytes = 0, end = 0;
  std::uint8_t op = 0;
};

enum class Step { kRecord, kEnd, kCut, kDamaged };

/// The record at `offset`; kCut if it reaches beyond `limit` (the rest of `record` is set), kDamaged if its kind is 0.
Step read_record(Window& window, std::uint64_t offset, std::uint64_t limit, Record& record);

/// Reads the fields of one record in order. After a field that is not there `good()` stays false and values are 0.
class Fields {
 public:
  explicit Fields(Bytes bytes) : bytes_(bytes) {}
  template <std::unsigned_integral T>
  T number() {
    const Bytes at = take(sizeof(T));
    return at.size() == sizeof(T) ? load_le<T>(at.data()) : T{0};
  }
  std::string_view text() { return as_text(block()); }
  /// u32 length and that many bytes.
  Bytes block() { return take(number<std::uint32_t>()); }
  Bytes take(std::uint64_t count) {
    if (count > bytes_.size()) good_ = false;
    if (!good_) return {};
    const Bytes taken = bytes_.first(static_cast<std::size_t>(count));
    bytes_ = bytes_.subspan(taken.size());
    return taken;
  }
  bool good() const { return good_; }
  bool empty() const { return bytes_.empty(); }

 private:
  Bytes bytes_;
  bool good_ = true;
};

struct Schema {
  std::uint16_t id = 0;
  std::string name, encoding, definition;
};
struct Channel {
  std::uint16_t id = 0, schema = 0;
  std::string topic, encoding, md5;  ///< md5 of its metadata, as ROS 1 recorders write it
};
struct ChunkHead {
  std::uint64_t begin_ns = 0, end_ns = 0, size = 0;
  std::uint32_t crc = 0;  ///< 0: not known
  std::string compression;
  std::uint64_t stored = 0;
  std::uint64_t data_offset = 0;  ///< of the stored bytes, in the file
};

std::optional<Schema> parse_schema(Bytes content);
std::optional<Channel> parse_channel(Bytes content);
/// From the first bytes of a chunk record, of which `content_bytes` are claimed in all.
std::optional<ChunkHead> parse_chunk(Bytes first, std::uint64_t content_offset, std::uint64_t content_bytes);

/// CRC-32 as in zlib.
std::uint32_t crc32_of(Bytes bytes, std::uint32_t before = 0);

}  // namespace vispline::mcap

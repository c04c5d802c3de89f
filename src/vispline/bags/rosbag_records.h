/// The records of a rosbag, format 2.0: u32 length, header fields `u32 length, name=value`, u32 length, data.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "vispline/bags/bag.h"
#include "vispline/bags/input.h"

namespace vispline::rosbag {

inline constexpr std::string_view kMagic = "#ROSBAG V2.0\n";
inline constexpr std::size_t kHeaderRecordBytes = 4096;  ///< of the first record, padded with blanks

enum Op : std::uint8_t {
  kNoOp = 0,
  kMessageData = 2,
  kFileHeader = 3,
  kIndexData = 4,
  kChunk = 5,
  kChunkInfo = 6,
  kConnection = 7,
};

/// One record and the fields of its header that anything here needs; those that are absent are empty.
struct Record {
  std::uint64_t offset = 0;       ///< of the record
  std::uint64_t data_offset = 0;  ///< of its data
  std::uint64_t data_bytes = 0;
  std::uint64_t end = 0;  ///< one past the data
  std::uint8_t op = kNoOp;
  std::optional<std::uint32_t> conn = {}, count = {}, size = {}, conn_count = {}, chunk_count = {}, version = {};
  std::optional<std::uint64_t> index_pos = {}, chunk_pos = {};
  std::optional<std::int64_t> time_ns = {}, start_ns = {}, end_ns = {};
  std::string text = {};  ///< compression of a chunk, topic of a connection, encryptor of the file
};

enum class Step {
  kRecord,   ///< a whole record
  kEnd,      ///< nothing more before the limit
  kCut,      ///< it reaches beyond the limit; if `op` is set its data begins before it
  kDamaged,  ///< no record stands here
};

/// The record at `offset`, of which nothing may stand at or beyond `limit`. Its data is not looked at.
Step read_record(Window& window, std::uint64_t offset, std::uint64_t limit, Record& record);

/// Topic, type, md5 and definition from the data of a connection record, which is a block of fields; nothing if it is
/// no such block. `topic` is that of the record's header and counts if the data names none.
std::optional<Topic> parse_connection(Bytes data, const std::string& topic);

/// Seconds and nanoseconds, u32 each.
std::int64_t time_at(const std::byte* at);

}  // namespace vispline::rosbag

#include "vispline/bags/mcap_records.h"

#include <zlib.h>

#include <algorithm>

namespace vispline::mcap {

Step read_record(Window& window, std::uint64_t offset, std::uint64_t limit, Record& record) {
  record = {.offset = offset};
  limit = std::min(limit, window.size());
  if (offset >= limit) return Step::kEnd;
  if (limit - offset < kRecordHead) return Step::kCut;
  const Bytes head = window.view(offset, kRecordHead);
  if (head.size() < kRecordHead) return Step::kCut;
  record.op = static_cast<std::uint8_t>(head[0]);
  record.content = offset + kRecordHead;
  record.bytes = load_le<std::uint64_t>(head.data() + 1);
  if (record.op == 0) return Step::kDamaged;
  if (record.bytes > limit - record.content) return Step::kCut;
  record.end = record.content + record.bytes;
  return Step::kRecord;
}

std::optional<Schema> parse_schema(Bytes content) {
  Fields fields(content);
  Schema schema;
  schema.id = fields.number<std::uint16_t>();
  schema.name = fields.text();
  schema.encoding = fields.text();
  schema.definition = as_text(fields.block());
  if (!fields.good()) return std::nullopt;
  return schema;
}

std::optional<Channel> parse_channel(Bytes content) {
  Fields fields(content);
  Channel channel;
  channel.id = fields.number<std::uint16_t>();
  channel.schema = fields.number<std::uint16_t>();
  channel.topic = fields.text();
  channel.encoding = fields.text();
  Fields metadata(fields.block());
  while (metadata.good() && !metadata.empty()) {
    const std::string_view key = metadata.text(), value = metadata.text();
    if (key == "md5sum") channel.md5 = value;
  }
  if (!fields.good() || !metadata.good()) return std::nullopt;
  return channel;
}

std::optional<ChunkHead> parse_chunk(Bytes first, std::uint64_t content_offset, std::uint64_t content_bytes) {
  Fields fields(first);
  ChunkHead chunk;
  chunk.begin_ns = fields.number<std::uint64_t>();
  chunk.end_ns = fields.number<std::uint64_t>();
  chunk.size = fields.number<std::uint64_t>();
  chunk.crc = fields.number<std::uint32_t>();
  chunk.compression = fields.text();
  chunk.stored = fields.number<std::uint64_t>();
  const std::uint64_t head = 8 + 8 + 8 + 4 + 4 + chunk.compression.size() + 8;
  chunk.data_offset = content_offset + head;
  if (!fields.good() || head > content_bytes || chunk.stored > content_bytes - head) return std::nullopt;
  return chunk;
}

std::uint32_t crc32_of(Bytes bytes, std::uint32_t before) {
  return static_cast<std::uint32_t>(
      ::crc32_z(before, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

}  // namespace vispline::mcap

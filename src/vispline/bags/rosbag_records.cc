#include "vispline/bags/rosbag_records.h"

#include <cstring>

namespace vispline::rosbag {
namespace {

constexpr std::size_t kMaxHeaderBytes = std::size_t{1} << 20;

/// Calls visit(name, value) for each field; false if the block is not made of fields.
template <class Visit>
bool each_field(Bytes block, const Visit& visit) {
  while (!block.empty()) {
    if (block.size() < 4) return false;
    const std::size_t length = load_le<std::uint32_t>(block.data());
    if (length > block.size() - 4) return false;
    const Bytes field = block.subspan(4, length);
    const void* equals = length == 0 ? nullptr : std::memchr(field.data(), '=', length);
    if (equals == nullptr) return false;
    const auto name_size = static_cast<std::size_t>(static_cast<const std::byte*>(equals) - field.data());
    visit(as_text(field.first(name_size)), field.subspan(name_size + 1));
    block = block.subspan(4 + length);
  }
  return true;
}

template <class T>
void take(std::optional<T>& to, Bytes value) {
  if (value.size() == sizeof(T)) to = load_le<T>(value.data());
}

void take_time(std::optional<std::int64_t>& to, Bytes value) {
  if (value.size() == 8) to = time_at(value.data());
}

/// The two fields of every message first: they are most of what is read.
void take_field(Record& record, std::string_view name, Bytes value) {
  if (name == "op") {
    if (value.size() == 1) record.op = static_cast<std::uint8_t>(value[0]);
  } else if (name == "conn") {
    take(record.conn, value);
  } else if (name == "time") {
    take_time(record.time_ns, value);
  } else if (name == "count") {
    take(record.count, value);
  } else if (name == "size") {
    take(record.size, value);
  } else if (name == "ver") {
    take(record.version, value);
  } else if (name == "index_pos") {
    take(record.index_pos, value);
  } else if (name == "conn_count") {
    take(record.conn_count, value);
  } else if (name == "chunk_count") {
    take(record.chunk_count, value);
  } else if (name == "chunk_pos") {
    take(record.chunk_pos, value);
  } else if (name == "start_time") {
    take_time(record.start_ns, value);
  } else if (name == "end_time") {
    take_time(record.end_ns, value);
  } else if (name == "compression" || name == "topic" || name == "encryptor") {
    record.text = as_text(value);
  }
}

}  // namespace

std::int64_t time_at(const std::byte* at) {
  return std::int64_t{load_le<std::uint32_t>(at)} * 1'000'000'000 + load_le<std::uint32_t>(at + 4);
}

Step read_record(Window& window, std::uint64_t offset, std::uint64_t limit, Record& record) {
  record = Record{.offset = offset};
  limit = std::min(limit, window.size());
  if (offset >= limit) return Step::kEnd;
  const std::uint64_t rest = limit - offset;
  if (rest < 4) return Step::kCut;
  const Bytes length = window.view(offset, 4);
  if (length.size() < 4) return Step::kCut;
  const std::size_t header_bytes = load_le<std::uint32_t>(length.data());
  if (header_bytes == 0 || header_bytes > kMaxHeaderBytes) return Step::kDamaged;
  if (header_bytes > rest - 4 || rest - 4 - header_bytes < 4) return Step::kCut;
  const Bytes header = window.view(offset + 4, header_bytes + 4);  // and the length of the data
  if (header.size() < header_bytes + 4) return Step::kCut;
  const bool fields =
      each_field(header.first(header_bytes), [&](auto name, Bytes value) { take_field(record, name, value); });
  if (!fields || record.op == kNoOp) return Step::kDamaged;
  record.data_offset = offset + 8 + header_bytes;
  record.data_bytes = load_le<std::uint32_t>(header.data() + header_bytes);
  record.end = record.data_offset + record.data_bytes;
  return record.data_bytes > limit - record.data_offset ? Step::kCut : Step::kRecord;
}

std::optional<Topic> parse_connection(Bytes data, const std::string& topic) {
  Topic result{.name = topic, .type = {}, .md5 = {}, .definition = {}, .wire = Wire::kRos1, .encoding = "ros1"};
  const bool fields = each_field(data, [&](std::string_view name, Bytes value) {
    if (name == "topic") result.name = as_text(value);
    if (name == "type") result.type = as_text(value);
    if (name == "md5sum") result.md5 = as_text(value);
    if (name == "message_definition") result.definition = as_text(value);
  });
  if (!fields || result.type.empty()) return std::nullopt;
  return result;
}

}  // namespace vispline::rosbag

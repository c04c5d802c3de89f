#include "vispline/bags/rosbag_writer.h"

#include <algorithm>
#include <map>

#include "vispline/bags/rosbag_records.h"

namespace vispline {
namespace {

using namespace rosbag;

constexpr std::int64_t kMaxTime = std::int64_t{UINT32_MAX} * 1'000'000'000 + 999'999'999;

/// The header of a record, field by field.
class Header {
 public:
  explicit Header(Op op) { field("op", std::string(1, static_cast<char>(op))); }
  Header& field(std::string_view name, std::string_view value) {
    store_le(bytes_, static_cast<std::uint32_t>(name.size() + 1 + value.size()));
    bytes_.append(name).append("=").append(value);
    return *this;
  }
  template <std::unsigned_integral T>
  Header& number(std::string_view name, T value) {
    std::string text;
    store_le(text, value);
    return field(name, text);
  }
  Header& time(std::string_view name, std::int64_t ns);
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

void store_time(std::string& out, std::int64_t ns) {
  store_le(out, static_cast<std::uint32_t>(ns / 1'000'000'000));
  store_le(out, static_cast<std::uint32_t>(ns % 1'000'000'000));
}

Header& Header::time(std::string_view name, std::int64_t ns) {
  std::string text;
  store_time(text, ns);
  return field(name, text);
}

void append_record(std::string& out, const Header& header, std::string_view data) {
  store_le(out, static_cast<std::uint32_t>(header.bytes().size()));
  out += header.bytes();
  store_le(out, static_cast<std::uint32_t>(data.size()));
  out += data;
}

std::string connection_record(std::uint32_t conn, const Topic& topic) {
  Header data(kConnection);  // its fields have the form of a header; the op is cut off again
  const std::size_t op_bytes = data.bytes().size();
  data.field("topic", topic.name).field("type", topic.type).field("md5sum", topic.md5);
  data.field("message_definition", topic.definition);
  std::string record;
  append_record(record, Header(kConnection).number("conn", conn).field("topic", topic.name),
                std::string_view(data.bytes()).substr(op_bytes));
  return record;
}

/// One message of a chunk, as its index record has it.
struct Entry {
  std::int64_t time_ns = 0;
  std::uint32_t offset = 0;
};

class RosbagWriter final : public BagWriter {
 public:
  RosbagWriter(const std::string& path, const BagWriterOptions& options)
      : file_(path, {.force = options.force}), options_(options) {
    require(options.compression != Codec::kZstd, "none, bz2 or lz4 for a rosbag");
    require(options.chunk_bytes <= kChunkBytes, "chunks of at most 256 MiB");
    put(kMagic);
    put(file_header(0, 0));
  }

  std::size_t add_topic(const Topic& topic) override {
    require(topic.wire == Wire::kRos1, "messages in the wire format of ROS 1 for a rosbag");
    connections_.push_back(connection_record(static_cast<std::uint32_t>(connections_.size()), topic));
    introduced_.push_back(false);
    return connections_.size() - 1;
  }

  void write(std::size_t topic, std::int64_t receive_ns, Bytes data) override {
    require(topic < connections_.size(), "a topic that was added");
    require(receive_ns >= 0 && receive_ns <= kMaxTime, "a time from 1970 to 2106 for a rosbag");
    require(data.size() <= kChunkBytes, "a message of at most 256 MiB");
    const auto conn = static_cast<std::uint32_t>(topic);
    if (!introduced_[topic]) chunk_ += connections_[topic];
    introduced_[topic] = true;
    entries_[conn].push_back({receive_ns, static_cast<std::uint32_t>(chunk_.size())});
    append_record(chunk_, Header(kMessageData).number("conn", conn).time("time", receive_ns), as_text(data));
    if (chunk_.size() >= options_.chunk_bytes) close_chunk();
  }

  void publish() override {
    close_chunk();
    const std::uint64_t index_pos = written_;
    for (const std::string& connection : connections_) put(connection);
    put(chunk_infos_);
    file_.patch(kMagic.size(), file_header(index_pos, chunks_));
    file_.publish();
  }

 private:
  std::string file_header(std::uint64_t index_pos, std::uint32_t chunks) const {
    Header header(kFileHeader);
    header.number("index_pos", index_pos);
    header.number("conn_count", static_cast<std::uint32_t>(connections_.size())).number("chunk_count", chunks);
    std::string record;
    append_record(record, header, std::string(kHeaderRecordBytes - header.bytes().size(), ' '));
    return record;
  }

  void close_chunk() {
    if (chunk_.empty()) return;
    std::string record;
    append_record(record,
                  Header(kChunk)
                      .field("compression", name_of(options_.compression))
                      .number("size", static_cast<std::uint32_t>(chunk_.size())),
                  options_.compression == Codec::kNone ? chunk_ : encode(options_.compression, chunk_));
    add_chunk_info();
    put(record);
    put_index();
    chunk_.clear();
    entries_.clear();
    ++chunks_;
  }

  void add_chunk_info() {
    std::int64_t start = kMaxTime, end = 0;
    std::string counts;
    for (const auto& [conn, entries] : entries_) {
      for (const Entry& entry : entries) {
        start = std::min(start, entry.time_ns);
        end = std::max(end, entry.time_ns);
      }
      store_le(counts, conn);
      store_le(counts, static_cast<std::uint32_t>(entries.size()));
    }
    Header header(kChunkInfo);
    header.number("ver", std::uint32_t{1}).number("chunk_pos", written_).time("start_time", start);
    header.time("end_time", end).number("count", static_cast<std::uint32_t>(entries_.size()));
    append_record(chunk_infos_, header, counts);
  }

  void put_index() {
    for (const auto& [conn, entries] : entries_) {
      std::string data;
      for (const Entry& entry : entries) {
        store_time(data, entry.time_ns);
        store_le(data, entry.offset);
      }
      std::string record;
      Header header(kIndexData);
      header.number("ver", std::uint32_t{1}).number("conn", conn);
      append_record(record, header.number("count", static_cast<std::uint32_t>(entries.size())), data);
      put(record);
    }
  }

  void put(std::string_view bytes) {
    file_.write(bytes);
    written_ += bytes.size();
  }

  OutputFile file_;
  BagWriterOptions options_;
  std::uint64_t written_ = 0;
  std::vector<std::string> connections_;  ///< records
  std::vector<bool> introduced_;          ///< the record stands in a chunk
  std::string chunk_, chunk_infos_;
  std::map<std::uint32_t, std::vector<Entry>> entries_;
  std::uint32_t chunks_ = 0;
};

}  // namespace

std::unique_ptr<BagWriter> make_rosbag_writer(const std::string& path, const BagWriterOptions& options) {
  return std::make_unique<RosbagWriter>(path, options);
}

}  // namespace vispline

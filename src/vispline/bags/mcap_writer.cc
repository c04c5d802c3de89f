#include "vispline/bags/mcap_writer.h"

#include <algorithm>
#include <map>

#include "vispline/bags/mcap_records.h"

namespace vispline {
namespace {

using namespace mcap;

/// The content of a record, field by field.
class Content {
 public:
  template <std::unsigned_integral T>
  Content& number(T value) {
    store_le(bytes_, value);
    return *this;
  }
  /// Text or a map, with its length.
  Content& block(std::string_view text) {
    number(static_cast<std::uint32_t>(text.size()));
    bytes_ += text;
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

void append_record(std::string& out, Op op, std::string_view content) {
  out += static_cast<char>(op);
  store_le(out, std::uint64_t{content.size()});
  out += content;
}

struct Span {
  std::uint64_t first = UINT64_MAX, last = 0;
  void take(std::uint64_t ns) {
    first = std::min(first, ns);
    last = std::max(last, ns);
  }
  std::uint64_t begin() const { return first == UINT64_MAX ? 0 : first; }
};

class McapWriter final : public BagWriter {
 public:
  McapWriter(const std::string& path, const BagWriterOptions& options)
      : file_(path, {.force = options.force}), options_(options) {
    require(options.compression != Codec::kBz2, "none, lz4 or zstd for an MCAP file");
    require(options.chunk_bytes <= kChunkBytes, "chunks of at most 256 MiB");
  }

  std::size_t add_topic(const Topic& topic) override {
    require(topic.wire != Wire::kOther, "messages in the wire format of ROS 1 or in CDR");
    require(channels_.size() < UINT16_MAX - 1, "fewer than 65534 topics");
    begin(topic.wire);
    const auto id = static_cast<std::uint16_t>(channels_.size() + 1);
    const bool ros1 = topic.wire == Wire::kRos1;
    Content schema, channel, metadata;
    schema.number(id).block(topic.type).block(ros1 ? "ros1msg" : "ros2msg").block(topic.definition);
    if (!topic.md5.empty()) metadata.block("md5sum").block(topic.md5);
    channel.number(id).number(id).block(topic.name).block(ros1 ? "ros1" : "cdr").block(metadata.bytes());
    std::string records;
    append_record(records, kSchema, schema.bytes());
    append_record(records, kChannel, channel.bytes());
    channels_.push_back(records);
    counts_.push_back(0);
    return channels_.size() - 1;
  }

  void write(std::size_t topic, std::int64_t receive_ns, Bytes data) override {
    require(topic < channels_.size(), "a topic that was added");
    require(receive_ns >= 0, "a time from 1970 on for an MCAP file");
    require(data.size() <= kChunkBytes - 1024, "a message of at most 256 MiB");
    if (counts_[topic] == 0) chunk_ += channels_[topic];
    const auto id = static_cast<std::uint16_t>(topic + 1);
    const auto ns = static_cast<std::uint64_t>(receive_ns);
    entries_[id].emplace_back(ns, chunk_.size());
    Content content;
    content.number(id).number(static_cast<std::uint32_t>(counts_[topic]++)).number(ns).number(ns);
    store_le(chunk_, std::uint8_t{kMessage});
    store_le(chunk_, std::uint64_t{content.bytes().size() + data.size()});
    chunk_.append(content.bytes()).append(as_text(data));
    chunk_span_.take(ns);
    if (chunk_.size() >= options_.chunk_bytes) close_chunk();
  }

  void publish() override {
    begin(Wire::kCdr);
    close_chunk();
    put_record(kDataEnd, Content().number(data_crc_).bytes());
    put_summary();
    put(kMagic);
    file_.publish();
  }

 private:
  /// The profile is that of the first topic, so the header waits for it.
  void begin(Wire wire) {
    if (written_ > 0) return;
    put(kMagic);
    put_record(kHeader, Content().block(wire == Wire::kRos1 ? "ros1" : "ros2").block("vispline").bytes());
  }

  void close_chunk() {
    if (chunk_.empty()) return;
    const std::string packed = options_.compression == Codec::kNone ? chunk_ : encode(options_.compression, chunk_);
    const std::string compression(options_.compression == Codec::kNone ? "" : name_of(options_.compression));
    Content chunk;
    chunk.number(chunk_span_.begin()).number(chunk_span_.last).number(std::uint64_t{chunk_.size()});
    chunk.number(crc32_of(as_bytes(chunk_))).block(compression).number(std::uint64_t{packed.size()});
    const std::uint64_t start = written_;
    put_record(kChunk, chunk.bytes() + packed);
    const std::uint64_t length = written_ - start;
    Content offsets;
    for (const auto& [channel, entries] : entries_) {
      offsets.number(channel).number(written_);
      put_message_index(channel, entries);
    }
    Content index;
    index.number(chunk_span_.begin()).number(chunk_span_.last).number(start).number(length).block(offsets.bytes());
    index.number(written_ - start - length).block(compression);
    index.number(std::uint64_t{packed.size()}).number(std::uint64_t{chunk_.size()});
    append_record(chunk_indexes_, kChunkIndex, index.bytes());
    ++chunks_;
    span_.take(chunk_span_.first);
    span_.take(chunk_span_.last);
    chunk_.clear();
    entries_.clear();
    chunk_span_ = {};
  }

  void put_message_index(std::uint16_t channel, const std::vector<std::pair<std::uint64_t, std::uint64_t>>& entries) {
    Content list;
    for (const auto& [ns, offset] : entries) list.number(ns).number(offset);
    put_record(kMessageIndex, Content().number(channel).block(list.bytes()).bytes());
  }

  std::string statistics() const {
    std::uint64_t messages = 0;
    Content counts;
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      messages += counts_[i];
      counts.number(static_cast<std::uint16_t>(i + 1)).number(counts_[i]);
    }
    Content content;
    content.number(messages).number(static_cast<std::uint16_t>(channels_.size()));
    content.number(static_cast<std::uint32_t>(channels_.size())).number(std::uint32_t{0}).number(std::uint32_t{0});
    content.number(chunks_).number(span_.begin()).number(span_.last).block(counts.bytes());
    std::string record;
    append_record(record, kStatistics, content.bytes());
    return record;
  }

  /// Schemas and channels, statistics, chunk indexes, where each group stands, and the footer.
  void put_summary() {
    const std::uint64_t start = written_;
    std::string summary, offsets;
    const auto group = [&](Op op, const std::string& records) {
      if (records.empty()) return;
      Content content;
      content.number(std::uint8_t{op}).number(start + summary.size()).number(std::uint64_t{records.size()});
      append_record(offsets, kSummaryOffset, content.bytes());
      summary += records;
    };
    std::string schemas, channels;
    for (const std::string& both : channels_) {
      const std::size_t schema =
          kRecordHead + static_cast<std::size_t>(load_le<std::uint64_t>(as_bytes(both).data() + 1));
      schemas.append(both, 0, schema);
      channels.append(both, schema);
    }
    group(kSchema, schemas);
    group(kChannel, channels);
    group(kStatistics, statistics());
    group(kChunkIndex, chunk_indexes_);
    Content footer;
    footer.number(start).number(start + summary.size());
    std::string covered = summary + offsets;
    covered += static_cast<char>(kFooter);
    store_le(covered, kFooterBytes);
    covered += footer.bytes();
    put(covered);
    put(Content().number(crc32_of(as_bytes(covered))).bytes());
  }

  void put_record(Op op, const std::string& content) {
    std::string record;
    append_record(record, op, content);
    put(record);
  }
  void put(std::string_view bytes) {
    file_.write(bytes);
    data_crc_ = crc32_of(as_bytes(bytes), data_crc_);
    written_ += bytes.size();
  }

  OutputFile file_;
  BagWriterOptions options_;
  std::uint64_t written_ = 0;
  std::uint32_t data_crc_ = 0, chunks_ = 0;
  std::vector<std::string> channels_;  ///< schema and channel record of each topic
  std::vector<std::uint64_t> counts_;
  std::string chunk_, chunk_indexes_;
  std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>> entries_;
  Span chunk_span_, span_;
};

}  // namespace

std::unique_ptr<BagWriter> make_mcap_writer(const std::string& path, const BagWriterOptions& options) {
  return std::make_unique<McapWriter>(path, options);
}

}  // namespace vispline

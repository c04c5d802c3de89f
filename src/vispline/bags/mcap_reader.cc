#include "vispline/bags/mcap_reader.h"

#include <algorithm>

#include "vispline/bags/mcap_chunk.h"
#include "vispline/bags/mcap_summary.h"
#include "vispline/bags/mcap_topics.h"
#include "vispline/bags/message_zstd.h"

namespace vispline {
namespace {

using namespace mcap;

constexpr std::uint64_t kMaxDescription = std::uint64_t{16} << 20;
constexpr std::size_t kMessageHead = 22;

std::optional<std::int64_t> time_of(std::uint64_t ns) {
  return ns <= INT64_MAX ? std::optional(static_cast<std::int64_t>(ns)) : std::nullopt;
}

class McapReader final : public BagReader {
 public:
  McapReader(Input input, const BagOptions& options) : BagReader(options), input_(std::move(input)) {
    summary_ = read_summary(input_);
    for (const Schema& schema : summary_.schemas) table_.add(schema);
    indexed_ = options.use_index && summary_.found && summary_.messages.has_value();
    if (indexed_) indexed_ = std::ranges::all_of(summary_.channels, [&](const Channel& c) { return add_channel(c); });
    if (indexed_) {
      take_statistics();
    } else {
      scan();
    }
  }

 private:
  void read_all(const std::vector<bool>& wanted) override {
    wanted_ = wanted;
    seen_ = 0;
    skipped_ = false;
    walk();
  }

  void take_statistics() {
    for (const Channel& channel : summary_.channels) {
      const auto count = summary_.counts.find(channel.id);
      topics_[*table_.find(channel.id)].count =
          count == summary_.counts.end() ? 0 : static_cast<std::int64_t>(count->second);
    }
  }

  void scan() {
    if (summary_.found && options_.use_index) {
      warn("W-INDEX", "the summary of the MCAP file has no statistics", input_.name(), kScanned);
    } else if (!summary_.wrong.empty()) {
      warn("W-INDEX", "the summary of the MCAP file cannot be used: " + summary_.wrong, input_.name(), kScanned);
    } else if (!summary_.found) {
      warn("W-UNINDEXED", "the MCAP file has no summary", input_.name(), kScanned);
    }
    keep_warnings_of_opening();
    for (Topic& topic : topics_) topic.count = 0;
    scanning_ = true;
    walk();
    scanning_ = false;
  }

  /// The data section from front to end.
  void walk() {
    Window window(input_);
    Record record;
    Step step;
    std::uint64_t offset = kMagic.size();
    while ((step = read_record(window, offset, summary_.data_end, record)) == Step::kRecord) {
      if (record.op == kDataEnd || record.op == kFooter) break;
      if (!take(window, record)) return;
      offset = record.end;
      if (!scanning_ && !report_progress(offset, input_.size())) return;
    }
    if (step == Step::kCut || step == Step::kDamaged) end_early(window, record, step);
    if (step == Step::kEnd && !summary_.found && summary_.wrong.empty() && !scanning_) {
      lose({offset, 0}, "W-TRUNCATED", "the data of the MCAP file has no end record", place(input_.name(), offset),
           kKept);
    }
    if (!scanning_) {
      compare();
      report_progress(input_.size(), input_.size());
    }
  }

  /// Nothing stands where a record should: the end of a cut file, or damage.
  void end_early(Window& window, const Record& record, Step step) {
    const std::uint64_t at = record.offset, rest = input_.size() - at;
    if (step == Step::kCut && record.op == kChunk) return cut_chunk(window, record);
    if (step == Step::kCut && summary_.data_end == input_.size()) {
      lose({at, rest}, "W-TRUNCATED", "the file ends inside a record", place(input_.name(), at), kKept);
    } else if (options_.repair || (step == Step::kDamaged && only_zeros(window, at))) {
      lose({at, rest}, "W-TRUNCATED", "no record of an MCAP file stands here", place(input_.name(), at), kKept);
    } else {
      fail_corrupt(place(input_.name(), at), "no record of an MCAP file stands here");
    }
  }

  bool only_zeros(Window& window, std::uint64_t offset) {
    constexpr std::size_t kPiece = std::size_t{1} << 16;
    for (; offset < input_.size(); offset += kPiece) {
      for (const std::byte byte : window.view(offset, kPiece)) {
        if (byte != std::byte{0}) return false;
      }
    }
    return true;
  }

  /// False: stop.
  bool take(Window& window, const Record& record) {
    switch (record.op) {
      case kChunk:
        return take_chunk(window, record, false);
      case kMessage:
        return take_message(window, record, record.offset);
      default:
        return take_description(window, record), true;
    }
  }

  void take_description(Window& window, const Record& record) {
    if (record.op != kSchema && record.op != kChannel) return;
    if (record.bytes > kMaxDescription) fail_limit(place(input_.name(), record.offset), "a description above 16 MiB");
    if (!scanning_) return;
    const Bytes content = window.view(record.content, static_cast<std::size_t>(record.bytes));
    if (record.op == kSchema) {
      if (const auto schema = parse_schema(content)) table_.add(*schema);
    } else if (const auto channel = parse_channel(content); channel && add_channel(*channel)) {
      auto& count = topics_[*table_.find(channel->id)].count;
      if (!count) count = 0;
    }
  }

  bool add_channel(const Channel& channel) { return table_.add(channel, topics_); }

  // ---- chunks

  bool take_chunk(Window& window, const Record& record, bool cut) {
    if (indexed_ && !scanning_ && !holds_wanted(record.offset)) {
      skipped_ = true;
      return true;
    }
    const std::uint64_t there = std::min(record.bytes, input_.size() - record.content);
    const Bytes first = window.view(record.content, static_cast<std::size_t>(std::min<std::uint64_t>(there, 256)));
    const auto head = parse_chunk(first, record.content, record.bytes);
    if (!head && cut) return lose_chunk(record, {}, "the file ends inside a chunk", true), true;
    if (!head) return lose_chunk(record, {}, "its header is damaged", false), true;
    const auto codec = codec_named(head->compression);
    if (!codec || *codec == Codec::kBz2) {
      fail_unsupported(place(input_.name(), record.offset),
                       "chunk compression " + vispline::quoted(head->compression) + " is not one of none, lz4, zstd",
                       "compress it anew: mcap compress");
    }
    const std::uint64_t stored = cut ? input_.size() - head->data_offset : head->stored;
    const std::string why = refusal(head->stored, head->size);
    if (!why.empty() && !cut) return lose_chunk(record, *head, why, false), true;
    return decode_chunk(window, record, *head, *codec, stored, cut);
  }

  bool holds_wanted(std::uint64_t chunk) const {
    const auto found = summary_.chunk_channels.find(chunk);
    if (found == summary_.chunk_channels.end()) return true;
    return std::ranges::any_of(found->second, [&](std::uint16_t id) {
      const auto topic = table_.find(id);
      return !topic || wanted_[*topic];
    });
  }

  bool decode_chunk(Window& window, const Record& record, const ChunkHead& head, Codec codec, std::uint64_t stored,
                    bool cut) {
    std::string why;
    const Bytes bytes = decoder_.decode(window, head, codec, stored, cut, why);
    if (!why.empty()) return lose_chunk(record, head, why, false), true;
    return take_records(bytes, record, head, cut);
  }

  bool take_records(Bytes bytes, const Record& chunk, const ChunkHead& head, bool cut) {
    Window memory(bytes);
    Record record;
    Step step;
    std::uint64_t offset = 0;
    while ((step = read_record(memory, offset, bytes.size(), record)) == Step::kRecord) {
      if (record.op == kMessage) {
        if (!take_message(memory, record, chunk.offset)) return false;
      } else {
        take_description(memory, record);
      }
      offset = record.end;
    }
    if (cut) {
      lose({chunk.offset, bytes.size() - offset, time_of(head.begin_ns), std::nullopt}, "W-TRUNCATED",
           "the file ends inside a chunk", place(input_.name(), chunk.offset), kKept);
    } else if (step != Step::kEnd) {
      lose({chunk.offset, bytes.size() - offset, time_of(head.begin_ns), time_of(head.end_ns)}, "W-CHUNK",
           "no record stands where one should", place(input_.name(), chunk.offset),
           "the rest of the chunk is left out");
    }
    return true;
  }

  void cut_chunk(Window& window, const Record& record) {
    if (summary_.data_end != input_.size() && !options_.repair) {
      fail_corrupt(place(input_.name(), record.offset), "a chunk reaches beyond the data of the MCAP file");
    }
    take_chunk(window, record, true);
  }

  void lose_chunk(const Record& record, const ChunkHead& head, const std::string& why, bool cut) {
    const bool times = head.data_offset != 0;
    lose({record.offset, std::min(record.bytes, input_.size() - record.content),
          times ? time_of(head.begin_ns) : std::nullopt, times ? time_of(head.end_ns) : std::nullopt},
         cut ? "W-TRUNCATED" : "W-CHUNK", cut ? why : "a chunk is damaged: " + why, place(input_.name(), record.offset),
         cut ? kKept : "the chunk is left out");
  }

  // ---- messages

  /// False: stop.
  bool take_message(Window& window, const Record& record, std::uint64_t offset) {
    const Bytes head = window.view(record.content, kMessageHead);
    if (record.bytes < kMessageHead || head.size() < kMessageHead) {
      if (!scanning_) drop("W-MESSAGE", "a message record is too short", place(input_.name(), offset));
      return true;
    }
    ++seen_;
    const auto topic = table_.find(load_le<std::uint16_t>(head.data()));
    const auto time = time_of(load_le<std::uint64_t>(head.data() + 6));
    if (scanning_) {
      if (topic) ++*topics_[*topic].count;
      return true;
    }
    if (topic && !wanted_[*topic]) return true;
    const std::uint64_t bytes = record.bytes - kMessageHead;
    std::string why;
    if (!topic) why = "a message of a channel that no record describes";
    if (!time) why = "a message of a time beyond 2262";
    if (bytes > kChunkBytes) why = "a message above 256 MiB";
    Bytes data;
    if (why.empty()) {
      data = plain_message(window.view(record.content + kMessageHead, static_cast<std::size_t>(bytes)), message_, why);
      if (!why.empty()) why = "a compressed message is damaged: " + why;
    }
    if (why.empty()) return deliver({*topic, *time, data, offset});
    drop("W-MESSAGE", why, place(input_.name(), offset));
    return true;
  }

  void compare() {
    if (!indexed_ || skipped_ || !lost().empty() || seen_ == *summary_.messages) return;
    warn("W-INDEX",
         "the statistics count " + std::to_string(*summary_.messages) + " messages, the file has " +
             std::to_string(seen_),
         input_.name(), "the data is believed");
  }

  static constexpr const char* kScanned = "scanned from front to end";
  static constexpr const char* kKept = "every whole message before it is read";

  Input input_;
  Summary summary_;
  TopicTable table_;
  ChunkDecoder decoder_;
  std::vector<bool> wanted_;
  std::uint64_t seen_ = 0;
  bool scanning_ = false, skipped_ = false;
  ByteBuffer message_;
};

}  // namespace

bool is_mcap(const Input& input) { return input.head(mcap::kMagic.size()) == mcap::kMagic; }

std::unique_ptr<BagReader> open_mcap(Input input, const BagOptions& options) {
  return std::make_unique<McapReader>(std::move(input), options);
}

}  // namespace vispline

#include "vispline/bags/rosbag_layout.h"

#include <algorithm>

namespace vispline::rosbag {
namespace {

constexpr std::size_t kReadAhead = 4096;  // the walk jumps from record to record
constexpr std::size_t kMaxChunks = 1'000'000;
constexpr std::size_t kMaxConnections = 65'536;
constexpr std::uint64_t kMaxConnectionBytes = std::uint64_t{16} << 20;

struct ChunkInfo {
  std::optional<std::int64_t> start_ns, end_ns;
  Counts counts;
};

class Walk {
 public:
  Walk(const Input& input, bool repair) : input_(input), window_(input, kReadAhead), repair_(repair) {}

  Layout run() {
    const std::uint64_t begin = read_file_header();
    if (layout_.closed && layout_.index_pos < input_.size()) read_index_section();
    walk_data(begin, index_good_ ? layout_.index_pos : input_.size());
    compare();
    return std::move(layout_);
  }

 private:
  std::uint64_t read_file_header() {
    if (input_.head(kMagic.size()) != kMagic) {
      fail_unsupported(
          input_.name(),
          "only rosbags of version 2.0 are read, this one begins with " + vispline::quoted(input_.head(kMagic.size())),
          "convert it: rosbag fix old.bag new.bag");
    }
    Record record;
    const Step step = read_record(window_, kMagic.size(), input_.size(), record);
    if (step == Step::kEnd || step == Step::kCut) {
      layout_.lost_tail = input_.size() - kMagic.size();
      return input_.size();
    }
    if (step != Step::kRecord || record.op != kFileHeader) {
      fail_corrupt(place(input_.name(), kMagic.size()), "the header of the rosbag is damaged");
    }
    if (!record.text.empty()) {
      fail_unsupported(input_.name(), "the rosbag is encrypted with " + vispline::quoted(record.text),
                       "decrypt it first: rosbag decrypt");
    }
    header_ = record;
    layout_.index_pos = record.index_pos.value_or(0);
    layout_.closed = layout_.index_pos != 0;
    return record.end;
  }

  /// All of it, or none is used.
  void read_index_section() {
    std::uint64_t offset = layout_.index_pos;
    Record record;
    Step step;
    while ((step = read_record(window_, offset, input_.size(), record)) == Step::kRecord) {
      if (record.op == kConnection && !add_connection(record)) return;
      if (record.op == kChunkInfo && !add_chunk_info(record)) return;
      if (record.op == kChunk || record.op == kMessageData) return;
      offset = record.end;
    }
    index_good_ = step == Step::kEnd || index_is_whole();
    const std::uint64_t rest = input_.size() - offset;
    if (index_good_) {
      layout_.surplus = rest;
    } else if (step == Step::kCut) {
      layout_.lost_tail = rest;
    }
  }

  /// Nothing is missing that the header counts.
  bool index_is_whole() const {
    return !infos_.empty() && header_.chunk_count == infos_.size() && header_.conn_count == layout_.connections.size();
  }

  bool add_connection(const Record& record) {
    if (!record.conn || record.data_bytes > kMaxConnectionBytes) return false;
    if (layout_.connections.size() >= kMaxConnections) fail_limit(input_.name(), "above 65536 connections");
    const auto topic =
        parse_connection(window_.view(record.data_offset, static_cast<std::size_t>(record.data_bytes)), record.text);
    if (topic) layout_.connections.emplace_back(*record.conn, *topic);
    return topic.has_value();
  }

  bool add_chunk_info(const Record& record) {
    if (!record.chunk_pos || !record.count || record.data_bytes != std::uint64_t{*record.count} * 8) return false;
    if (infos_.size() >= kMaxChunks || *record.count > kMaxConnections) fail_limit(input_.name(), "too many chunks");
    const Bytes data = window_.view(record.data_offset, static_cast<std::size_t>(record.data_bytes));
    ChunkInfo info{record.start_ns, record.end_ns, {}};
    for (std::size_t i = 0; i + 8 <= data.size(); i += 8) {
      info.counts.emplace_back(load_le<std::uint32_t>(data.data() + i), load_le<std::uint32_t>(data.data() + i + 4));
    }
    std::ranges::sort(info.counts);
    infos_[*record.chunk_pos] = std::move(info);
    return true;
  }

  void walk_data(std::uint64_t offset, std::uint64_t limit) {
    Record record;
    Step step;
    while ((step = read_record(window_, offset, limit, record)) != Step::kEnd) {
      if (step == Step::kRecord) {
        take(record);
        offset = record.end;
      } else if (step == Step::kCut && limit == input_.size() && !data_follows(offset)) {
        return cut(record, offset);
      } else {
        offset = step_over(offset, limit);
      }
    }
  }

  void take(const Record& record) {
    if (record.op == kChunk) {
      add_chunk(record, record.data_bytes, false);
    } else if (record.op == kIndexData && record.conn && record.count && !layout_.chunks.empty()) {
      layout_.chunks.back().counts.emplace_back(*record.conn, *record.count);
    } else if (record.op == kConnection && !index_good_) {
      add_connection(record);  // of an index section that is not whole
    }
  }

  void add_chunk(const Record& record, std::uint64_t stored, bool is_cut) {
    if (layout_.chunks.size() >= kMaxChunks) fail_limit(input_.name(), "above 1 million chunks");
    ChunkPlace chunk{.offset = record.offset,
                     .data_offset = record.data_offset,
                     .stored = stored,
                     .size = record.size.value_or(0),
                     .compression = record.text,
                     .cut = is_cut};
    if (const auto info = infos_.find(record.offset); index_good_ && info != infos_.end()) {
      chunk.begin_ns = info->second.start_ns;
      chunk.end_ns = info->second.end_ns;
    }
    layout_.chunks.push_back(std::move(chunk));
  }

  /// The index is behind `offset`, so that no file ends there.
  bool data_follows(std::uint64_t offset) const {
    return layout_.closed && layout_.index_pos > offset && layout_.index_pos < input_.size();
  }

  void cut(const Record& record, std::uint64_t offset) {
    if (record.op == kChunk) return add_chunk(record, input_.size() - record.data_offset, true);
    layout_.lost_tail = input_.size() - offset;
  }

  /// Over damage to the next chunk the index knows; without an index, to the end.
  std::uint64_t step_over(std::uint64_t offset, std::uint64_t limit) {
    if (index_good_) {
      const auto next = infos_.upper_bound(offset);
      const std::uint64_t to = next == infos_.end() || next->first > limit ? limit : next->first;
      Hole hole{offset, to - offset, {}, {}};
      if (next != infos_.begin()) {
        hole.begin_ns = std::prev(next)->second.start_ns;
        hole.end_ns = std::prev(next)->second.end_ns;
      }
      layout_.holes.push_back(hole);
      return to;
    }
    if (only_zeros(offset)) {  // what a power cut leaves
      layout_.lost_tail = input_.size() - offset;
    } else if (repair_) {
      layout_.holes.push_back({offset, limit - offset, {}, {}});
    } else {
      fail_corrupt(place(input_.name(), offset), "no record of a rosbag stands here, and no index helps to go on");
    }
    return limit;
  }

  bool only_zeros(std::uint64_t offset) const {
    Window window(input_);
    constexpr std::size_t kPiece = std::size_t{1} << 16;
    for (; offset < input_.size(); offset += kPiece) {
      for (const std::byte byte : window.view(offset, kPiece)) {
        if (byte != std::byte{0}) return false;
      }
    }
    return true;
  }

  /// Chunk infos against the index records behind the chunks, and both against the counts of the header.
  void compare() {
    for (ChunkPlace& chunk : layout_.chunks) std::ranges::sort(chunk.counts);
    if (!index_good_) return;
    std::string& why = layout_.disagreement;
    if (infos_.size() != layout_.chunks.size() || header_.chunk_count.value_or(0) != layout_.chunks.size()) {
      why = "the index knows " + std::to_string(infos_.size()) + " chunks, the header " +
            std::to_string(header_.chunk_count.value_or(0)) + ", the file has " + std::to_string(layout_.chunks.size());
    } else if (header_.conn_count.value_or(0) != layout_.connections.size()) {
      why = "the header counts " + std::to_string(header_.conn_count.value_or(0)) + " connections, the index " +
            std::to_string(layout_.connections.size());
    }
    for (const ChunkPlace& chunk : layout_.chunks) {
      if (!why.empty()) return;
      const auto info = infos_.find(chunk.offset);
      if (info == infos_.end() || info->second.counts != chunk.counts) {
        why = "the index and the chunk at byte " + std::to_string(chunk.offset) + " count different messages";
      }
    }
  }

  const Input& input_;
  Window window_;
  bool repair_;
  bool index_good_ = false;
  Record header_;
  std::map<std::uint64_t, ChunkInfo> infos_;
  Layout layout_;
};

}  // namespace

Layout find_layout(const Input& input, bool repair) { return Walk(input, repair).run(); }

}  // namespace vispline::rosbag

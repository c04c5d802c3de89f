#include "vispline/bags/rosbag_reader.h"

#include <algorithm>

#include "vispline/bags/chunk_codec.h"
#include "vispline/bags/rosbag_layout.h"

namespace vispline {
namespace {

using rosbag::ChunkPlace;
using rosbag::Record;
using rosbag::Step;

constexpr std::size_t kDecodePiece = std::size_t{1} << 18;
constexpr std::size_t kMaxConnections = 65'536;
constexpr std::uint64_t kMaxConnectionBytes = std::uint64_t{16} << 20;

class RosbagReader final : public BagReader {
 public:
  RosbagReader(Input input, const BagOptions& options)
      : BagReader(options), input_(std::move(input)), layout_(rosbag::find_layout(input_, options.repair)) {
    for (const auto& [conn, topic] : layout_.connections) add_topic(conn, topic);
    indexed_ = options.use_index && index_agrees();
    tell_of_the_file();
    if (indexed_) {
      take_counts_of_index();
    } else {
      scan_for_topics();
    }
  }

 private:
  void read_all(const std::vector<bool>& wanted) override {
    wanted_ = wanted;
    Window window(input_);
    for (const ChunkPlace& chunk : layout_.chunks) {
      if (indexed_ && !holds_wanted(chunk)) continue;
      if (!read_chunk(window, chunk)) return;
      if (!report_progress(chunk.data_offset + chunk.stored, input_.size())) return;
    }
    report_progress(input_.size(), input_.size());
  }

  // ---- the file as a whole

  bool index_agrees() const {
    if (!layout_.closed || !layout_.disagreement.empty() || !layout_.holes.empty() || layout_.lost_tail > 0)
      return false;
    if (layout_.index_pos >= input_.size()) return layout_.chunks.empty() && layout_.index_pos == input_.size();
    return std::ranges::all_of(layout_.chunks, [&](const ChunkPlace& chunk) {
      return std::ranges::all_of(chunk.counts, [&](const auto& count) { return conns_.contains(count.first); });
    });
  }

  void tell_of_the_file() {
    const std::string& name = input_.name();
    for (const auto& hole : layout_.holes) {
      lose({hole.offset, hole.bytes, hole.begin_ns, hole.end_ns}, "W-CHUNK", "no record of a rosbag stands here",
           place(name, hole.offset), "read on at byte " + std::to_string(hole.offset + hole.bytes));
    }
    const bool cut_chunk = !layout_.chunks.empty() && layout_.chunks.back().cut;
    const std::uint64_t missing = layout_.index_pos > input_.size() ? layout_.index_pos - input_.size() : 0;
    if (layout_.lost_tail > 0 || missing > 0) {
      const std::uint64_t at = input_.size() - layout_.lost_tail;
      lose({at, layout_.lost_tail + missing}, "W-TRUNCATED", "the file is cut at byte " + std::to_string(input_.size()),
           place(name, at), "every whole message before it is read");
    } else if (!layout_.closed) {
      warn("W-UNINDEXED", "the rosbag was not closed and has no index", name,
           cut_chunk ? "scanned from front to end; it ends inside a chunk" : "scanned from front to end");
    } else if (options_.use_index && !indexed_ && !cut_chunk && layout_.holes.empty()) {
      warn("W-INDEX", layout_.disagreement.empty() ? "the index of the rosbag cannot be used" : layout_.disagreement,
           name, "the data is believed and scanned from front to end");
    }
    if (layout_.surplus > 0) {
      warn("W-INDEX", std::to_string(layout_.surplus) + " bytes behind the index are no part of a rosbag",
           place(name, input_.size() - layout_.surplus), "they are left out");
    }
    keep_warnings_of_opening();
  }

  void take_counts_of_index() {
    for (Topic& topic : topics_) topic.count = 0;
    for (const ChunkPlace& chunk : layout_.chunks) {
      for (const auto& [conn, count] : chunk.counts) *topics_[conns_.at(conn)].count += count;
    }
  }

  void scan_for_topics() {
    scanning_ = true;
    for (Topic& topic : topics_) topic.count = 0;
    Window window(input_);
    for (const ChunkPlace& chunk : layout_.chunks) read_chunk(window, chunk);
    scanning_ = false;
  }

  void add_topic(std::uint32_t conn, const Topic& topic) {
    if (conns_.contains(conn)) return;
    if (topics_.size() >= kMaxConnections) fail_limit(input_.name(), "above 65536 connections");
    conns_[conn] = topics_.size();
    topics_.push_back(topic);
  }

  // ---- one chunk

  bool holds_wanted(const ChunkPlace& chunk) const {
    return std::ranges::any_of(chunk.counts, [&](const auto& count) { return wanted_[conns_.at(count.first)]; });
  }

  /// False: stop.
  bool read_chunk(Window& window, const ChunkPlace& chunk) {
    const auto codec = codec_named(chunk.compression);
    if (!codec || *codec == Codec::kZstd) {
      fail_unsupported(place(input_.name(), chunk.offset),
                       "chunk compression " + vispline::quoted(chunk.compression) + " is not one of none, bz2, lz4",
                       "compress it anew: rosbag compress --bz2");
    }
    if (*codec != Codec::kNone) return read_compressed(window, chunk, *codec);
    if (!chunk.cut && chunk.size != chunk.stored) {
      warn("W-CHUNK",
           "the chunk claims " + std::to_string(chunk.size) + " bytes and has " + std::to_string(chunk.stored),
           place(input_.name(), chunk.offset), "all of it is read");
    }
    return read_records(window, chunk.data_offset, chunk.data_offset + chunk.stored, chunk, true);
  }

  bool read_compressed(Window& window, const ChunkPlace& chunk, Codec codec) {
    std::string why = refusal(chunk.stored, chunk.size);
    if (!why.empty() && !chunk.cut) return lose_chunk(chunk, why);
    const auto cap = static_cast<std::size_t>(std::min(chunk.size, growth_cap(chunk.stored)));
    decoded_.clear();
    const auto decoder = make_decoder(codec);
    bool good = true;
    for (std::uint64_t done = 0; done < chunk.stored && good;) {
      const auto piece = static_cast<std::size_t>(std::min<std::uint64_t>(kDecodePiece, chunk.stored - done));
      const Bytes in = window.view(chunk.data_offset + done, piece);
      if (in.empty()) break;
      good = decoder->feed(in, decoded_, cap);
      done += in.size();
    }
    if (!chunk.cut) {
      if (!good || !decoder->finished()) return lose_chunk(chunk, good ? "it ends early" : decoder->error());
      if (decoded_.size() != chunk.size) return lose_chunk(chunk, "it holds less than it claims");
    }
    Window memory(decoded_.view());
    return read_records(memory, 0, decoded_.size(), chunk, false);
  }

  bool lose_chunk(const ChunkPlace& chunk, const std::string& why) {
    lose({chunk.offset, chunk.stored, chunk.begin_ns, chunk.end_ns}, "W-CHUNK", "a chunk is damaged: " + why,
         place(input_.name(), chunk.offset), "the chunk is left out");
    return true;
  }

  /// The records of a chunk, in the file or decoded.
  bool read_records(Window& window, std::uint64_t begin, std::uint64_t end, const ChunkPlace& chunk, bool in_file) {
    Record record;
    Step step;
    std::uint64_t offset = begin;
    std::optional<std::int64_t> last_ns;
    std::uint64_t messages = 0;
    while ((step = rosbag::read_record(window, offset, end, record)) == Step::kRecord) {
      if (record.op == rosbag::kMessageData) {
        if (!record.conn || !record.time_ns) break;
        ++messages;
        last_ns = record.time_ns;
        if (!take_message(window, record, in_file ? record.offset : chunk.offset)) return false;
      } else if (record.op == rosbag::kConnection) {
        if (!take_connection(window, record)) break;
      }
      offset = record.end;
    }
    if (step != Step::kEnd || chunk.cut) {
      lose_rest(chunk, offset - begin, end - offset, last_ns, in_file);
    } else if (indexed_) {
      compare(chunk, messages);
    }
    return true;
  }

  /// Of a cut chunk `rest` bytes make no whole message; of one that is damaged they cannot be told apart.
  void lose_rest(const ChunkPlace& chunk, std::uint64_t good, std::uint64_t rest, std::optional<std::int64_t> last_ns,
                 bool in_file) {
    const std::uint64_t at = in_file ? chunk.data_offset + good : chunk.offset;
    if (chunk.cut) {
      lose({at, rest, last_ns, std::nullopt}, "W-TRUNCATED", "the file ends inside a chunk", place(input_.name(), at),
           "every whole message before it is read");
    } else {
      lose({at, rest, last_ns ? last_ns : chunk.begin_ns, chunk.end_ns}, "W-CHUNK",
           "no message stands where one should", place(input_.name(), at), "the rest of this chunk is left out");
    }
  }

  void compare(const ChunkPlace& chunk, std::uint64_t messages) {
    std::uint64_t claimed = 0;
    for (const auto& [conn, count] : chunk.counts) claimed += count;
    if (claimed == messages) return;
    warn("W-INDEX",
         "the index counts " + std::to_string(claimed) + " messages in a chunk that has " + std::to_string(messages),
         place(input_.name(), chunk.offset), "the data is believed; set use_index off");
  }

  bool take_connection(Window& window, const Record& record) {
    if (!record.conn || record.data_bytes > kMaxConnectionBytes) return false;
    if (!scanning_ || conns_.contains(*record.conn)) return true;
    const auto topic = rosbag::parse_connection(
        window.view(record.data_offset, static_cast<std::size_t>(record.data_bytes)), record.text);
    if (topic) {
      add_topic(*record.conn, *topic);
      topics_.back().count = 0;
    }
    return topic.has_value();
  }

  /// False: stop.
  bool take_message(Window& window, const Record& record, std::uint64_t offset) {
    const auto conn = conns_.find(*record.conn);
    if (scanning_) {
      if (conn != conns_.end()) ++*topics_[conn->second].count;
      return true;
    }
    if (conn == conns_.end()) {
      drop("W-MESSAGE", "a message of connection " + std::to_string(*record.conn) + ", which no record describes",
           place(input_.name(), offset));
      return true;
    }
    if (!wanted_[conn->second]) return true;
    if (record.data_bytes > kChunkBytes) {
      drop("W-MESSAGE", "a message of " + std::to_string(record.data_bytes) + " bytes, above 256 MiB",
           place(input_.name(), offset));
      return true;
    }
    const Bytes data = window.view(record.data_offset, static_cast<std::size_t>(record.data_bytes));
    return deliver({conn->second, *record.time_ns, data, offset});
  }

  Input input_;
  rosbag::Layout layout_;
  std::unordered_map<std::uint32_t, std::size_t> conns_;
  std::vector<bool> wanted_;
  bool scanning_ = false;
  ByteBuffer decoded_;
};

}  // namespace

bool is_rosbag(const Input& input) { return input.head(8) == "#ROSBAG "; }

std::unique_ptr<BagReader> open_rosbag(Input input, const BagOptions& options) {
  return std::make_unique<RosbagReader>(std::move(input), options);
}

}  // namespace vispline

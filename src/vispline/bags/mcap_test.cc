#include "vispline/bags/bags_testing.h"
#include "vispline/bags/mcap_records.h"

namespace vispline {
namespace {

constexpr Codec kCodecs[] = {Codec::kNone, Codec::kLz4, Codec::kZstd};

class Mcap : public ::testing::Test {
 protected:
  std::string file(const Recording& recording, Codec codec, std::size_t chunk_bytes = 4000) const {
    return bytes_of(
        written(folder_, "x.mcap", recording, Container::kMcap, {.compression = codec, .chunk_bytes = chunk_bytes}));
  }
  static std::uint64_t footer_number(const std::string& bytes, std::size_t field) {
    return load_le<std::uint64_t>(as_bytes(bytes).data() + bytes.size() - 8 - 20 + 8 * field);
  }
  /// Without summary, data end and magic at the end.
  static std::string unclosed(const std::string& bytes) { return bytes.substr(0, footer_number(bytes, 0) - 13); }
  const BagFolder folder_;
  const Recording small_ = made_up(60, 300, Wire::kCdr);
};

TEST_F(Mcap, ReadsWhatItWrites) {
  for (const Wire wire : {Wire::kCdr, Wire::kRos1}) {
    for (const Codec codec : kCodecs) {
      for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{2000}}) {
        const Recording recording = made_up(count, 3000, wire);
        const BagOutcome outcome = outcome_of_bytes(file(recording, codec, 100'000));
        EXPECT_EQ(outcome.codes, "") << outcome.text;
        EXPECT_TRUE(outcome.indexed);
        EXPECT_EQ(outcome.messages, recording.messages);
        ASSERT_EQ(outcome.topics.size(), recording.topics.size());
        for (const Topic& topic : outcome.topics) {
          const Topic& expected = *std::ranges::find(recording.topics, topic.name, &Topic::name);
          EXPECT_EQ(topic.type, expected.type);
          EXPECT_EQ(topic.md5, expected.md5);
          EXPECT_EQ(topic.definition, expected.definition);
          EXPECT_EQ(topic.wire, wire);
          EXPECT_EQ(topic.count, std::ranges::count(recording.messages, topic.name, &Recorded::topic));
        }
      }
    }
  }
}

TEST_F(Mcap, SkipsChunksOfOtherTopics) {
  Recording recording = made_up(400, 300, Wire::kCdr);
  std::ranges::stable_sort(recording.messages, {}, &Recorded::topic);
  const auto reader = open_bag(Input::from_memory(file(recording, Codec::kZstd), "memory"));
  const BagOutcome outcome = outcome_of(*reader, [](const Topic& topic) { return topic.name == "/pose"; });
  EXPECT_EQ(outcome.codes, "");
  EXPECT_EQ(std::ssize(outcome.messages), std::ranges::count(recording.messages, "/pose", &Recorded::topic));
}

TEST_F(Mcap, NotClosed) {
  for (const Codec codec : kCodecs) {
    const BagOutcome outcome = outcome_of_bytes(unclosed(file(small_, codec)));
    EXPECT_EQ(outcome.codes, "W-TRUNCATED W-UNINDEXED");
    EXPECT_EQ(outcome.messages, small_.messages);
    EXPECT_EQ(outcome.topics.size(), 3u);
  }
}

TEST_F(Mcap, CutAtEveryByte) {
  const Recording recording = made_up(24, 60, Wire::kCdr);
  for (const Codec codec : kCodecs) {
    const std::string whole = file(recording, codec, 700);
    std::size_t kept = 0;
    for (std::size_t size = 8; size < whole.size(); ++size) {
      const BagOutcome outcome = outcome_of_bytes(whole.substr(0, size));
      ASSERT_EQ(outcome.exit, 0) << size << outcome.text;
      ASSERT_NE(outcome.codes, "") << size;
      ASSERT_GE(outcome.messages.size(), kept) << size;
      kept = outcome.messages.size();
      ASSERT_TRUE(std::equal(outcome.messages.begin(), outcome.messages.end(), recording.messages.begin())) << size;
    }
    EXPECT_EQ(kept, recording.messages.size());
  }
}

TEST_F(Mcap, ChunkCrc) {
  const Recording recording = made_up(5000, 300, Wire::kCdr);
  for (const Codec codec : kCodecs) {
    std::string bytes = file(recording, codec);
    const Input input = Input::from_memory(bytes, "memory");
    Window window(input);
    mcap::Record record;
    for (std::uint64_t at = 8; record.op != mcap::kChunk || at < bytes.size() / 2; at = record.end) {
      ASSERT_EQ(mcap::read_record(window, at, bytes.size(), record), mcap::Step::kRecord);
    }
    bytes[record.content + record.bytes / 2] ^= 4;
    const BagOutcome outcome = outcome_of_bytes(bytes);
    EXPECT_EQ(outcome.codes, "W-CHUNK") << outcome.text;
    ASSERT_EQ(outcome.lost.size(), 1u);
    EXPECT_LT(outcome.messages.size(), recording.messages.size());
    EXPECT_TRUE(is_part_of(outcome.messages, recording.messages));
    EXPECT_GT(*outcome.lost[0].end_ns, *outcome.lost[0].begin_ns);
  }
}

TEST_F(Mcap, SummaryCrc) {
  std::string bytes = file(small_, Codec::kZstd);
  bytes[footer_number(bytes, 0) + 20] ^= 1;
  const BagOutcome outcome = outcome_of_bytes(bytes);
  EXPECT_EQ(outcome.codes, "W-INDEX");
  EXPECT_FALSE(outcome.indexed);
  EXPECT_EQ(outcome.messages, small_.messages);
}

TEST_F(Mcap, WrongStatistics) {
  std::string bytes = file(small_, Codec::kLz4);
  std::size_t at = footer_number(bytes, 0);
  while (bytes[at] != mcap::kStatistics) at += 9 + load_le<std::uint64_t>(as_bytes(bytes).data() + at + 1);
  bytes[at + 9] ^= 1;
  bytes.replace(bytes.size() - 12, 4, std::string(4, '\0'));  // no CRC
  const BagOutcome outcome = outcome_of_bytes(bytes);
  EXPECT_EQ(outcome.codes, "W-INDEX");
  EXPECT_EQ(outcome.messages, small_.messages);
}

TEST_F(Mcap, ScanEqualsIndex) {
  for (const Codec codec : kCodecs) {
    const std::string bytes = file(small_, codec);
    const BagOutcome scan = outcome_of_bytes(bytes, {.use_index = false});
    EXPECT_EQ(scan.codes, "");
    EXPECT_FALSE(scan.indexed);
    EXPECT_EQ(scan.messages, small_.messages);
  }
}

TEST_F(Mcap, MessagesCompressedOneByOne) {
  Recording packed = small_;
  for (Recorded& message : packed.messages) message.data = encode(Codec::kZstd, message.data);
  EXPECT_EQ(outcome_of_bytes(file(packed, Codec::kNone)).messages, small_.messages);
  packed.messages[7].data.pop_back();
  const BagOutcome outcome = outcome_of_bytes(file(packed, Codec::kNone));
  EXPECT_EQ(outcome.codes, "W-MESSAGE");
  EXPECT_EQ(outcome.messages.size(), small_.messages.size() - 1);
}

TEST_F(Mcap, UnknownCompression) {
  std::string bytes = file(small_, Codec::kLz4);
  bytes.replace(bytes.find("lz4"), 3, "xz9");
  EXPECT_EQ(outcome_of_bytes(bytes).codes, "E-UNSUPPORTED");
}

}  // namespace
}  // namespace vispline

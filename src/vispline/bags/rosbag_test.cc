#include "vispline/bags/bags_testing.h"
#include "vispline/bags/rosbag_records.h"

namespace vispline {
namespace {

constexpr Codec kCodecs[] = {Codec::kNone, Codec::kBz2, Codec::kLz4};

class Rosbag : public ::testing::Test {
 protected:
  std::string bag(const Recording& recording, Codec codec, std::size_t chunk_bytes = 4000) const {
    return bytes_of(
        written(folder_, "x.bag", recording, Container::kRosbag, {.compression = codec, .chunk_bytes = chunk_bytes}));
  }
  /// The same file as if it had not been closed: no index section, no word of it in the header.
  static std::string unclosed(std::string bytes) {
    const std::size_t at = bytes.find("index_pos=") + 10;
    const auto index = load_le<std::uint64_t>(as_bytes(bytes).data() + at);
    bytes.replace(at, 8, std::string(8, '\0'));
    return bytes.substr(0, index);
  }
  const BagFolder folder_;
  const Recording small_ = made_up(60, 300, Wire::kRos1);
};

TEST_F(Rosbag, ReadsWhatItWrites) {
  for (const Codec codec : kCodecs) {
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{2000}}) {
      const Recording recording = made_up(count, 3000, Wire::kRos1);
      const BagOutcome outcome = outcome_of_bytes(bag(recording, codec, 100'000));
      EXPECT_EQ(outcome.codes, "") << outcome.text;
      EXPECT_TRUE(outcome.indexed);
      EXPECT_EQ(outcome.messages, recording.messages);
      ASSERT_EQ(outcome.topics.size(), recording.topics.size());
      for (std::size_t i = 0; i < outcome.topics.size(); ++i) {
        const auto& name = recording.topics[i].name;
        EXPECT_EQ(outcome.topics[i].name, name);
        EXPECT_EQ(outcome.topics[i].type, "sensor_msgs/Imu");
        EXPECT_EQ(outcome.topics[i].md5, recording.topics[i].md5);
        EXPECT_EQ(outcome.topics[i].definition, recording.topics[i].definition);
        EXPECT_EQ(outcome.topics[i].count,
                  std::ranges::count_if(recording.messages, [&](const auto& m) { return m.topic == name; }));
      }
    }
  }
}

TEST_F(Rosbag, FiltersTopicsAndStops) {
  const std::string bytes = bag(small_, Codec::kBz2);
  const auto reader = open_bag(Input::from_memory(bytes, "memory"));
  const BagOutcome poses = outcome_of(*reader, [](const Topic& topic) { return topic.name == "/pose"; });
  std::vector<Recorded> expected;
  for (const Recorded& m : small_.messages) {
    if (m.topic == "/pose") expected.push_back(m);
  }
  EXPECT_EQ(poses.messages, expected);
  EXPECT_EQ(outcome_of(*reader).messages, small_.messages);  // again, and all
  int given = 0;
  reader->read([](const Topic&) { return true; }, [&](const Message&) { return ++given < 7; });
  EXPECT_EQ(given, 7);
  EXPECT_EQ(reader->counts().kept, 7);
}

TEST_F(Rosbag, OffsetsPointAtRecords) {
  const std::string bytes = bag(small_, Codec::kNone);
  const Input input = Input::from_memory(bytes, "memory");
  Window window(input);
  open_bag(Input::from_memory(bytes, "memory"))
      ->read([](const Topic&) { return true; },
             [&](const Message& message) {
               rosbag::Record record;
               EXPECT_EQ(rosbag::read_record(window, message.offset, input.size(), record), rosbag::Step::kRecord);
               EXPECT_EQ(record.op, rosbag::kMessageData);
               EXPECT_EQ(record.time_ns, message.receive_ns);
               return true;
             });
}

TEST_F(Rosbag, HeaderRecordHas4096Bytes) {
  const std::string bytes = bag(small_, Codec::kNone);
  const Input input = Input::from_memory(bytes, "memory");
  Window window(input);
  rosbag::Record record;
  ASSERT_EQ(rosbag::read_record(window, 13, input.size(), record), rosbag::Step::kRecord);
  EXPECT_EQ(record.end - 13, 4096u + 8u);  // lengths of header and data together are 4096
}

TEST_F(Rosbag, NotClosed) {
  for (const Codec codec : kCodecs) {
    const BagOutcome outcome = outcome_of_bytes(unclosed(bag(small_, codec)));
    EXPECT_EQ(outcome.codes, "W-UNINDEXED");
    EXPECT_FALSE(outcome.indexed);
    EXPECT_EQ(outcome.messages, small_.messages);
    EXPECT_EQ(outcome.topics.size(), 3u);  // the one without messages is nowhere
    EXPECT_EQ(outcome.topics.at(0).name, "/pose");
    EXPECT_EQ(outcome.topics.at(0).count, 16);
  }
}

TEST_F(Rosbag, CutAtEveryByte) {
  const Recording recording = made_up(24, 60, Wire::kRos1);
  for (const Codec codec : kCodecs) {
    for (const bool closed : {true, false}) {
      std::string whole = bag(recording, codec, 700);
      if (!closed) whole = unclosed(whole);
      std::size_t kept = 0;
      for (std::size_t size = 14; size < whole.size(); ++size) {
        const BagOutcome outcome = outcome_of_bytes(whole.substr(0, size));
        ASSERT_EQ(outcome.exit, 0) << size << outcome.text;
        // Between two records of the index nothing is cut, but the index is not whole.
        const bool told = outcome.codes == "W-TRUNCATED" || outcome.codes == "W-INDEX";
        ASSERT_TRUE(closed ? told : outcome.codes.starts_with("W-")) << size << " " << outcome.codes;
        ASSERT_GE(outcome.messages.size(), kept) << size;
        kept = outcome.messages.size();
        ASSERT_TRUE(std::equal(outcome.messages.begin(), outcome.messages.end(), recording.messages.begin())) << size;
      }
      EXPECT_EQ(kept, recording.messages.size());
    }
  }
}

TEST_F(Rosbag, CutSaysBytesLost) {
  const std::string whole = unclosed(bag(small_, Codec::kNone, 1 << 20));
  const BagOutcome outcome = outcome_of_bytes(whole.substr(0, 12'000));
  EXPECT_EQ(outcome.codes, "W-TRUNCATED W-UNINDEXED");
  ASSERT_EQ(outcome.lost.size(), 1u);
  EXPECT_EQ(outcome.lost[0].offset + outcome.lost[0].bytes, 12'000u);
  EXPECT_EQ(outcome.lost[0].begin_ns, outcome.messages.back().receive_ns);
}

TEST_F(Rosbag, ZerosAtTheEnd) {
  const BagOutcome outcome = outcome_of_bytes(unclosed(bag(small_, Codec::kLz4)) + std::string(5000, '\0'));
  EXPECT_EQ(outcome.codes, "W-TRUNCATED");
  EXPECT_EQ(outcome.lost.at(0).bytes, 5000u);
  EXPECT_EQ(outcome.messages, small_.messages);
}

TEST_F(Rosbag, DamagedChunkIsLeftOutWithItsTime) {
  const Recording recording = made_up(5000, 300, Wire::kRos1);
  std::string bytes = bag(recording, Codec::kBz2, 4000);
  const std::size_t chunk = bytes.find("compression=bz2", bytes.size() / 3);
  for (std::size_t i = chunk + 100; i < chunk + 140; ++i) bytes[i] = static_cast<char>(~bytes[i]);
  const BagOutcome outcome = outcome_of_bytes(bytes);
  EXPECT_EQ(outcome.codes, "W-CHUNK") << outcome.text;
  ASSERT_EQ(outcome.lost.size(), 1u);
  const double lost = static_cast<double>(*outcome.lost[0].end_ns - *outcome.lost[0].begin_ns) * 1e-9;
  EXPECT_NEAR(lost, static_cast<double>(recording.messages.size() - outcome.messages.size() - 1) * 1e-3, 1e-9);
  EXPECT_LT(outcome.messages.size(), recording.messages.size() - 10);
  EXPECT_TRUE(is_part_of(outcome.messages, recording.messages));
  const BagOutcome scan = outcome_of_bytes(bytes, {.use_index = false});
  EXPECT_EQ(scan.messages, outcome.messages);
}

TEST_F(Rosbag, MuchDamageIsAnErrorUnlessRepaired) {
  std::string bytes = bag(small_, Codec::kBz2);
  const std::size_t chunk = bytes.find("compression=bz2", 6000);
  for (std::size_t i = chunk + 100; i < chunk + 140; ++i) bytes[i] = static_cast<char>(~bytes[i]);
  for (const bool use_index : {true, false}) {
    EXPECT_EQ(outcome_of_bytes(bytes, {.use_index = use_index}).codes, "E-CHUNK");
    const BagOutcome repaired = outcome_of_bytes(bytes, {.use_index = use_index, .repair = true});
    EXPECT_EQ(repaired.codes, "W-CHUNK");
    EXPECT_TRUE(is_part_of(repaired.messages, small_.messages));
  }
}

TEST_F(Rosbag, DamagedRecordIsSteppedOverByTheIndex) {
  const Recording recording = made_up(5000, 300, Wire::kRos1);
  std::string bytes = bag(recording, Codec::kNone, 4000);
  const std::size_t length = bytes.find("compression=none", bytes.size() / 3) + 16 + 13;
  bytes.replace(length, 4, "\xff\xff\xff\x7f");  // the chunk claims 2 GiB
  const BagOutcome outcome = outcome_of_bytes(bytes);
  EXPECT_EQ(outcome.codes, "W-CHUNK") << outcome.text;
  EXPECT_TRUE(is_part_of(outcome.messages, recording.messages));
  EXPECT_GT(outcome.messages.size(), recording.messages.size() - 40);
}

TEST_F(Rosbag, DamageWithoutAnIndex) {
  std::string bytes = unclosed(bag(small_, Codec::kNone));
  const std::size_t second = bytes.find("compression=none", 6000) - 4 - 9 - 4;
  bytes.replace(second, 4, "\xff\xff\xff\xff");
  EXPECT_EQ(outcome_of_bytes(bytes).codes, "E-CORRUPT");
  const BagOutcome repaired = outcome_of_bytes(bytes, {.repair = true});
  EXPECT_EQ(repaired.exit, 0);
  EXPECT_GT(repaired.messages.size(), 5u);
}

TEST_F(Rosbag, WrongIndex) {
  const std::string good = bag(small_, Codec::kLz4);
  for (const char* field : {"conn_count=", "chunk_count="}) {
    std::string bytes = good;
    bytes[bytes.find(field) + std::string(field).size()] ^= 1;
    const BagOutcome outcome = outcome_of_bytes(bytes);
    EXPECT_EQ(outcome.codes, "W-INDEX");
    EXPECT_EQ(outcome.messages, small_.messages);
  }
  std::string bytes = good;  // the count of one connection in the last chunk info
  bytes[bytes.size() - 4] ^= 1;
  const BagOutcome outcome = outcome_of_bytes(bytes);
  EXPECT_EQ(outcome.codes, "W-INDEX");
  EXPECT_EQ(outcome.messages, small_.messages);
  EXPECT_EQ(outcome.topics.at(0).count, 32);
}

TEST_F(Rosbag, BytesBehindTheIndex) {
  for (const std::string& more :
       {std::string(7, '\0'), std::string("garbage behind the index"), std::string("\5\0\0\0", 4)}) {
    const BagOutcome outcome = outcome_of_bytes(bag(small_, Codec::kLz4) + more);
    EXPECT_EQ(outcome.codes, "W-INDEX");
    EXPECT_EQ(outcome.messages, small_.messages);
  }
}

TEST_F(Rosbag, ChunkThatClaimsTooMuch) {
  std::string bytes = bag(small_, Codec::kBz2, 1 << 20);
  const std::size_t size = bytes.find("size=", 4100) + 5;
  bytes.replace(size, 4, "\xff\xff\xff\x7f");
  const BagOutcome outcome = outcome_of_bytes(bytes);
  EXPECT_EQ(outcome.codes, "W-CHUNK");
  EXPECT_NE(outcome.text.find("256 MiB"), std::string::npos) << outcome.text;
  EXPECT_TRUE(outcome.messages.empty());
}

TEST_F(Rosbag, RefusesWhatItCannotRead) {
  std::string unknown = bag(small_, Codec::kBz2);
  unknown.replace(unknown.find("=bz2") + 1, 3, "xz9");
  EXPECT_EQ(outcome_of_bytes(unknown).codes, "E-UNSUPPORTED");
  EXPECT_EQ(outcome_of_bytes("#ROSBAG V1.2\n").codes, "E-UNSUPPORTED");
  EXPECT_EQ(outcome_of_bytes("").codes, "E-EMPTY");
  EXPECT_EQ(outcome_of_bytes("PK\3\4").codes, "E-FORMAT");
  std::string header;
  for (const std::string& field : {std::string("op=\3"), std::string("encryptor=rosbag/AesCbcEncryptor")}) {
    store_le(header, static_cast<std::uint32_t>(field.size()));
    header += field;
  }
  std::string encrypted = "#ROSBAG V2.0\n";
  store_le(encrypted, static_cast<std::uint32_t>(header.size()));
  const BagOutcome outcome = outcome_of_bytes(encrypted + header + std::string(4, '\0'));
  EXPECT_EQ(outcome.codes, "E-UNSUPPORTED");
  EXPECT_NE(outcome.text.find("AesCbc"), std::string::npos);
}

TEST_F(Rosbag, OpensRegularFilesOnly) {
  EXPECT_EQ(outcome_of_file(folder_.path("absent.bag")).codes, "E-OPEN");
  EXPECT_EQ(outcome_of_file("/dev/zero").codes, "E-OPEN");
  EXPECT_FALSE(is_bag(folder_.path("absent.bag")));
  EXPECT_TRUE(is_bag(written(folder_, "no suffix", small_, Container::kRosbag)));
}

TEST_F(Rosbag, ProgressCanStop) {
  const Recording recording = made_up(4000, 3000, Wire::kRos1);
  std::vector<std::uint64_t> done;
  const auto progress = [&](std::uint64_t bytes, std::uint64_t total) {
    EXPECT_LE(bytes, total);
    done.push_back(bytes);
    return done.size() < 3;
  };
  const BagOutcome outcome = outcome_of_bytes(bag(recording, Codec::kNone, 100'000), {.progress = progress});
  EXPECT_EQ(done.size(), 3u);
  EXPECT_TRUE(std::ranges::is_sorted(done));
  EXPECT_LT(outcome.messages.size(), recording.messages.size());
}

}  // namespace
}  // namespace vispline

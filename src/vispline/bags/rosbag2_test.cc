#include <sqlite3.h>

#include "vispline/bags/bags_testing.h"
#include "vispline/bags/db3_reader.h"
#include "vispline/bags/rosbag2_metadata.h"

namespace vispline {
namespace {

class Rosbag2 : public ::testing::Test {
 protected:
  std::string folder_bag(const Recording& recording) const {
    return written(folder_, "run", recording, Container::kRosbag2);
  }
  /// What `sql` does to the database.
  void change(const std::string& sql) const {
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(db3_.c_str(), &database), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(database);
    sqlite3_close(database);
  }
  void replace_metadata(const std::string& from, const std::string& to) const {
    std::string text = bytes_of(folder_.path("run/metadata.yaml"));
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
      text.replace(at, from.size(), to);
    }
    folder_.write("run/metadata.yaml", text);
  }
  const BagFolder folder_;
  const std::string db3_ = folder_.path("run/run_0.db3");
  const Recording small_ = made_up(60, 300, Wire::kCdr);
};

TEST_F(Rosbag2, ReadsWhatItWrites) {
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{2000}}) {
    const Recording recording = made_up(count, 9000, Wire::kCdr);
    const std::string path = folder_bag(recording);
    for (const std::string& name : {path, db3_}) {
      const BagOutcome outcome = outcome_of_file(name);
      EXPECT_EQ(outcome.codes, "") << outcome.text;
      EXPECT_EQ(outcome.messages, recording.messages);
      ASSERT_EQ(outcome.topics.size(), recording.topics.size());
      for (const Topic& topic : outcome.topics) {
        EXPECT_EQ(topic.type, "sensor_msgs/msg/Imu");
        EXPECT_EQ(topic.wire, Wire::kCdr);
        EXPECT_EQ(topic.count, std::ranges::count(recording.messages, topic.name, &Recorded::topic));
      }
    }
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path("run")), {}), 2);
}

TEST_F(Rosbag2, KeepsAnOldRecording) {
  const std::string path = folder_bag(small_);
  EXPECT_THROW(make_bag_writer(Container::kRosbag2, path), Error);
  {
    const auto unfinished = make_bag_writer(Container::kRosbag2, path, {.force = true});
    unfinished->add_topic(small_.topics[0]);
  }
  EXPECT_EQ(outcome_of_file(path).messages, small_.messages);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path), {}), 2);
}

TEST_F(Rosbag2, MetadataAbsentCutOrWrong) {
  const std::string path = folder_bag(small_);
  replace_metadata("message_count: 60", "message_count: 61");
  EXPECT_EQ(outcome_of_file(path).codes, "W-METADATA");
  for (const char* text : {"rosbag2_bagfile_information:\n  ver", "\t[", "a: *b", "[[[[", ""}) {
    folder_.write("run/metadata.yaml", text);
    const BagOutcome outcome = outcome_of_file(path);
    EXPECT_EQ(outcome.codes, "W-METADATA") << text;
    EXPECT_EQ(outcome.messages, small_.messages);
  }
  std::filesystem::remove(folder_.path("run/metadata.yaml"));
  EXPECT_EQ(outcome_of_file(path).messages, small_.messages);
}

TEST_F(Rosbag2, ListedFilesStayInTheFolder) {
  folder_.write("secret.db3", "");
  for (const char* name : {"../secret.db3", "/etc/passwd", "absent.db3", "x/../../secret.db3", "link.db3"}) {
    const std::string path = folder_bag(small_);
    std::filesystem::remove(folder_.path("run/link.db3"));
    std::filesystem::create_symlink(folder_.path("secret.db3"), folder_.path("run/link.db3"));
    replace_metadata("run_0.db3", name);
    EXPECT_EQ(outcome_of_file(path).codes, "E-PATH") << name;
  }
  const std::string path = folder_bag(small_);
  replace_metadata("run_0.db3", "some_folder/run_0.db3");  // as rosbag2 wrote it up to version 3
  EXPECT_EQ(outcome_of_file(path).messages, small_.messages);
}

TEST_F(Rosbag2, SeveralFilesAndCompressedFiles) {
  const std::string path = folder_bag(small_);
  for (const char* second : {"run_1.mcap", "run_1.db3.zstd"}) {
    if (std::string(second) == "run_1.mcap") {
      written(folder_, "run/run_1.mcap", small_, Container::kMcap);
    } else {
      folder_.write("run/run_1.db3.zstd", encode(Codec::kZstd, bytes_of(db3_)));
    }
    folder_.write("run/metadata.yaml", std::string("rosbag2_bagfile_information:\n  message_count: 120\n") +
                                           "  relative_file_paths: [run_0.db3, " + second + "]\n");
    const BagOutcome outcome = outcome_of_file(path);
    EXPECT_EQ(outcome.codes, "") << outcome.text;
    std::vector<Recorded> twice = small_.messages;
    twice.insert(twice.end(), small_.messages.begin(), small_.messages.end());
    EXPECT_EQ(outcome.messages, twice);
    EXPECT_EQ(outcome.topics.size(), 4u);
  }
  std::string cut = encode(Codec::kZstd, bytes_of(db3_));
  folder_.write("run/run_1.db3.zstd", cut.substr(0, cut.size() - 5));
  EXPECT_EQ(outcome_of_file(path).codes, "E-CORRUPT");
}

TEST_F(Rosbag2, MessagesCompressedOneByOne) {
  Recording packed = small_;
  for (Recorded& message : packed.messages) message.data = encode(Codec::kZstd, message.data);
  EXPECT_EQ(outcome_of_file(folder_bag(packed)).messages, small_.messages);
}

TEST_F(Rosbag2, NullTextAndUnknownRowsAreLeftOut) {
  folder_bag(small_);
  change("PRAGMA writable_schema=1; UPDATE sqlite_master SET sql=replace(sql,'data BLOB NOT NULL','data BLOB')");
  change(
      "UPDATE messages SET data=NULL WHERE id=3; UPDATE messages SET data='text' WHERE id=4;"
      "UPDATE messages SET topic_id=99 WHERE id=5; UPDATE messages SET timestamp='noon' WHERE id=6;");
  const BagOutcome outcome = outcome_of_file(db3_);
  EXPECT_EQ(outcome.codes, "W-DATABASE");
  EXPECT_EQ(outcome.messages.size(), small_.messages.size() - 4);
}

TEST_F(Rosbag2, RefusesViewsAndMissingTables) {
  for (const char* sql :
       {"ALTER TABLE messages RENAME TO hidden; CREATE VIEW messages AS SELECT * FROM hidden", "DROP TABLE topics",
        "ALTER TABLE messages RENAME COLUMN data TO bytes",
        "DROP TABLE topics; CREATE VIRTUAL TABLE topics USING fts5(id,name,type,serialization_format)"}) {
    folder_bag(small_);
    change(sql);
    EXPECT_EQ(outcome_of_file(db3_).codes, "E-DATABASE") << sql;
  }
}

TEST_F(Rosbag2, GeneratedColumnsRunNoFunction) {
  folder_bag(small_);
  change(
      "DROP TABLE messages; CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id, timestamp,"
      " data BLOB AS (zeroblob(200000000))); INSERT INTO messages(topic_id, timestamp) VALUES (1, 5)");
  EXPECT_EQ(outcome_of_file(db3_).codes, "E-DATABASE");
}

TEST_F(Rosbag2, RowsInAWalFile) {
  folder_bag(small_);
  sqlite3* writer = nullptr;
  ASSERT_EQ(sqlite3_open(db3_.c_str(), &writer), SQLITE_OK);
  sqlite3_exec(writer, "PRAGMA journal_mode=WAL; INSERT INTO messages VALUES (1000, 1, 5, x'00010000')", nullptr,
               nullptr, nullptr);
  const std::string before = bytes_of(db3_), wal = bytes_of(db3_ + "-wal");
  ASSERT_FALSE(wal.empty());
  const BagOutcome outcome = outcome_of_file(db3_);
  EXPECT_EQ(outcome.codes, "W-DATABASE") << outcome.text;
  EXPECT_EQ(outcome.messages.size(), small_.messages.size() + 1);
  EXPECT_EQ(bytes_of(db3_), before);
  EXPECT_EQ(bytes_of(db3_ + "-wal"), wal);
  sqlite3_close(writer);
}

TEST_F(Rosbag2, CutAtManyBytes) {
  folder_bag(small_);
  const std::string whole = bytes_of(db3_);
  for (std::size_t size = 0; size < whole.size(); size += size < 200 ? 1 : 97) {
    const BagOutcome outcome = outcome_of_opening([&] { return open_db3_bytes(whole.substr(0, size), "memory", {}); });
    const bool last_page = size > whole.size() - 4096;  // it belongs to the index by time, which is not needed
    ASSERT_TRUE(outcome.codes == "E-DATABASE" || (last_page && outcome.messages == small_.messages)) << size;
  }
  EXPECT_EQ(outcome_of_opening([&] { return open_db3_bytes(whole, "memory", {}); }).messages, small_.messages);
}

TEST_F(Rosbag2, MetadataOfHostileText) {
  EXPECT_NE(parse_metadata(std::string(2 << 20, 'x')).wrong, "");
  EXPECT_NE(parse_metadata(std::string(100'000, '[')).wrong, "");
  EXPECT_NE(parse_metadata("rosbag2_bagfile_information: {relative_file_paths: []}").wrong, "");
  EXPECT_NE(parse_metadata("rosbag2_bagfile_information: 5").wrong, "");
  EXPECT_EQ(parse_metadata("rosbag2_bagfile_information: {relative_file_paths: [a.db3]}").files.at(0), "a.db3");
}

}  // namespace
}  // namespace vispline

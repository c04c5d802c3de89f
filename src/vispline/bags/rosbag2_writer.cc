#include "vispline/bags/rosbag2_writer.h"

#include <fcntl.h>
#include <sqlite3.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "vispline/bags/input.h"
#include "vispline/bags/rosbag2_metadata.h"

namespace vispline {
namespace {

namespace fs = std::filesystem;

/// Text as a YAML scalar in double quotes.
std::string yaml_text(std::string_view text) {
  static constexpr std::string_view kHex = "0123456789abcdef";
  std::string quoted_text = "\"";
  for (const unsigned char c : text) {
    if (c == '"' || c == '\\') quoted_text += '\\';
    if (c < 0x20 || c == 0x7f) {
      quoted_text += {'\\', 'x', kHex[c >> 4], kHex[c & 15]};
    } else {
      quoted_text += static_cast<char>(c);
    }
  }
  return quoted_text + "\"";
}

struct Written {
  std::string name, type;
  std::int64_t count = 0;
};

class Rosbag2Writer final : public BagWriter {
 public:
  Rosbag2Writer(std::string folder, const BagWriterOptions& options) : folder_(std::move(folder)), options_(options) {
    require(options.compression == Codec::kNone, "no compression for a rosbag2 database");
    while (folder_.size() > 1 && folder_.ends_with('/')) folder_.pop_back();
    file_ = fs::path(folder_).filename().string() + "_0.db3";
    claim_names();
    open();
  }

  ~Rosbag2Writer() override {
    close();
    if (!partial_.empty()) ::unlink(partial_.c_str());
  }

  std::size_t add_topic(const Topic& topic) override {
    require(topic.wire == Wire::kCdr, "messages in CDR for a rosbag2");
    bind(topic_, 1, static_cast<std::int64_t>(topics_.size() + 1));
    bind(topic_, 2, topic.name);
    bind(topic_, 3, topic.type);
    step(topic_);
    topics_.push_back({topic.name, topic.type, 0});
    return topics_.size() - 1;
  }

  void write(std::size_t topic, std::int64_t receive_ns, Bytes data) override {
    require(topic < topics_.size(), "a topic that was added");
    require(receive_ns >= 0, "a time from 1970 on for a rosbag2");
    require(data.size() <= kChunkBytes, "a message of at most 256 MiB");
    bind(message_, 1, static_cast<std::int64_t>(topic + 1));
    bind(message_, 2, receive_ns);
    const void* bytes = data.empty() ? static_cast<const void*>("") : data.data();
    if (sqlite3_bind_blob64(message_, 3, bytes, data.size(), SQLITE_STATIC) != SQLITE_OK)
      fail(sqlite3_errmsg(database_));
    step(message_);
    ++topics_[topic].count;
    first_ = messages_ == 0 ? receive_ns : std::min(first_, receive_ns);
    last_ = std::max(last_, receive_ns);
    ++messages_;
  }

  void publish() override {
    run("COMMIT; CREATE INDEX timestamp_idx ON messages (timestamp ASC)");
    close();
    sync_partial();
    const std::string final_name = folder_ + "/" + file_;
    if (options_.force ? ::rename(partial_.c_str(), final_name.c_str()) != 0
                       : ::renameat2(AT_FDCWD, partial_.c_str(), AT_FDCWD, final_name.c_str(), RENAME_NOREPLACE) != 0) {
      fail(std::generic_category().message(errno));
    }
    partial_.clear();
    write_file(folder_ + "/" + kMetadataName, metadata(), {.force = options_.force});
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw Error(ExitCode::kOutput, {.code = "E-OUTPUT",
                                    .message = "cannot write " + vispline::quoted(folder_ + "/" + file_) + ": " + why,
                                    .where = "",
                                    .effect = "no recording written",
                                    .next = "name a new folder on a disk with room, or pass --force"});
  }

  /// Both names must be free, or files that may be replaced.
  void claim_names() {
    for (const std::string& name : {file_, std::string(kMetadataName)}) {
      probe_output(folder_ + "/" + name, 0, {.force = options_.force});
    }
    for (int attempt = 0; attempt < 100; ++attempt) {
      const std::string name =
          folder_ + "/" + file_ + "." + std::to_string(::getpid()) + "-" + std::to_string(attempt) + ".partial";
      const int fd = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644);
      if (fd < 0) continue;
      ::close(fd);
      partial_ = name;
      return;
    }
    fail("no partial file can be made in its folder");
  }

  void open() {
    if (sqlite3_open_v2(partial_.c_str(), &database_, SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOFOLLOW, nullptr) !=
        SQLITE_OK) {
      fail(sqlite3_errmsg(database_));
    }
    run("PRAGMA journal_mode=OFF; PRAGMA synchronous=OFF; BEGIN;"
        "CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);"
        "INSERT INTO schema VALUES (3, 'humble');"
        "CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL, metadata TEXT NOT NULL);"
        "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,"
        " serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);"
        "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL,"
        " data BLOB NOT NULL);");
    topic_ = prepare("INSERT INTO topics VALUES (?, ?, ?, 'cdr', '')");
    message_ = prepare("INSERT INTO messages (topic_id, timestamp, data) VALUES (?, ?, ?)");
  }

  void close() {
    sqlite3_finalize(std::exchange(topic_, nullptr));
    sqlite3_finalize(std::exchange(message_, nullptr));
    sqlite3_close(std::exchange(database_, nullptr));
  }

  void run(const char* sql) {
    if (sqlite3_exec(database_, sql, nullptr, nullptr, nullptr) != SQLITE_OK) fail(sqlite3_errmsg(database_));
  }
  sqlite3_stmt* prepare(const char* sql) {
    sqlite3_stmt* statement = nullptr;
    if (sqlite3_prepare_v2(database_, sql, -1, &statement, nullptr) != SQLITE_OK) fail(sqlite3_errmsg(database_));
    return statement;
  }
  void bind(sqlite3_stmt* statement, int index, std::int64_t value) { sqlite3_bind_int64(statement, index, value); }
  void bind(sqlite3_stmt* statement, int index, const std::string& text) {
    sqlite3_bind_text(statement, index, text.c_str(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
  }
  void step(sqlite3_stmt* statement) {
    if (sqlite3_step(statement) != SQLITE_DONE) fail(sqlite3_errmsg(database_));
    sqlite3_reset(statement);
  }

  void sync_partial() {
    const int fd = ::open(partial_.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
    const bool good = fd >= 0 && ::fsync(fd) == 0;
    const std::string why = good ? "" : std::generic_category().message(errno);
    if (fd >= 0) ::close(fd);
    if (!good) fail(why);
  }

  std::string metadata() const {
    const std::string duration = std::to_string(last_ - first_), start = std::to_string(first_);
    std::string text = "rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: sqlite3\n";
    text += "  duration:\n    nanoseconds: " + duration + "\n";
    text += "  starting_time:\n    nanoseconds_since_epoch: " + start + "\n";
    text += "  message_count: " + std::to_string(messages_) + "\n";
    text += topics_.empty() ? "  topics_with_message_count: []\n" : "  topics_with_message_count:\n";
    for (const Written& topic : topics_) {
      text +=
          "    - topic_metadata:\n        name: " + yaml_text(topic.name) + "\n        type: " + yaml_text(topic.type);
      text += "\n        serialization_format: cdr\n        offered_qos_profiles: \"\"\n";
      text += "      message_count: " + std::to_string(topic.count) + "\n";
    }
    text += "  compression_format: \"\"\n  compression_mode: \"\"\n";
    text += "  relative_file_paths:\n    - " + yaml_text(file_) + "\n";
    text += "  files:\n    - path: " + yaml_text(file_) +
            "\n      starting_time:\n        nanoseconds_since_epoch: " + start;
    text +=
        "\n      duration:\n        nanoseconds: " + duration + "\n      message_count: " + std::to_string(messages_);
    return text + "\n";
  }

  std::string folder_, file_, partial_;
  BagWriterOptions options_;
  sqlite3* database_ = nullptr;
  sqlite3_stmt *topic_ = nullptr, *message_ = nullptr;
  std::vector<Written> topics_;
  std::int64_t messages_ = 0, first_ = 0, last_ = 0;
};

}  // namespace

std::unique_ptr<BagWriter> make_rosbag2_writer(const std::string& folder, const BagWriterOptions& options) {
  return std::make_unique<Rosbag2Writer>(folder, options);
}

}  // namespace vispline

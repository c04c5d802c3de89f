#include "vispline/bags/db3_reader.h"

#include <unordered_map>

#include "vispline/bags/message_zstd.h"
#include "vispline/bags/sqlite_file.h"

namespace vispline {
namespace {

constexpr std::size_t kMaxTopics = 65'536;

class Db3Reader final : public BagReader {
 public:
  Db3Reader(SqliteFile file, std::uint64_t bytes, const BagOptions& options)
      : BagReader(options), file_(std::move(file)), bytes_(bytes) {
    for (const char* table : {"topics", "messages"}) {
      if (!file_.has_table(table)) fail_database(file_.name(), std::string("it has no plain table ") + table);
    }
    if (file_.copied()) {
      warn("W-DATABASE", "rows stand in a -wal file beside the database", file_.name(), "read from a private copy");
    }
    read_topics();
    read_counts();
    indexed_ = true;
    keep_warnings_of_opening();
  }

 private:
  void read_topics() {
    SqliteRows rows = file_.rows("SELECT id, name, type, serialization_format FROM topics");
    while (rows.next()) {
      if (!rows.is_integer(0) || !rows.is_text(1) || !rows.is_text(2)) {
        fail_database(file_.name(), "a row of its topics is not id, name, type");
      }
      if (topics_.size() >= kMaxTopics) fail_limit(file_.name(), "above 65536 topics");
      const std::string encoding = rows.text(3);
      ids_[rows.integer(0)] = topics_.size();
      topics_.push_back({.name = rows.text(1),
                         .type = rows.text(2),
                         .md5 = {},
                         .definition = {},
                         .wire = encoding == "cdr" ? Wire::kCdr : Wire::kOther,
                         .encoding = encoding,
                         .count = 0});
    }
  }

  void read_counts() {
    each_row("SELECT rowid, topic_id FROM messages", [&](SqliteRows& rows) {
      const auto id = rows.is_integer(1) ? ids_.find(rows.integer(1)) : ids_.end();
      if (id != ids_.end()) ++*topics_[id->second].count;
      ++rows_;
      return true;
    });
  }

  void read_all(const std::vector<bool>& wanted) override {
    wanted_ = wanted;
    std::int64_t row = 0;
    each_row("SELECT rowid, topic_id, timestamp, data FROM messages", [&](SqliteRows& rows) {
      const auto done = static_cast<std::uint64_t>(static_cast<double>(bytes_) * static_cast<double>(++row) /
                                                   static_cast<double>(rows_ + 1));
      return take(rows) && report_progress(done, bytes_);
    });
    report_progress(bytes_, bytes_);
  }

  /// Rows come by rowid. In a crafted file one page may stand in many places of the tree, so that it never ends.
  template <class Visit>
  void each_row(const std::string& select, const Visit& visit) {
    SqliteRows rows = file_.rows(select + " ORDER BY rowid");
    std::optional<std::int64_t> last;
    while (rows.next()) {
      const std::int64_t id = rows.integer(0);
      if (last && id <= *last) fail_database(file_.name(), "its rows are out of order after " + std::to_string(*last));
      last = id;
      if (!visit(rows)) return;
    }
  }

  /// False: stop.
  bool take(SqliteRows& rows) {
    const auto where = [&] { return file_.name() + ", row " + std::to_string(rows.integer(0)); };
    const auto id = rows.is_integer(1) ? ids_.find(rows.integer(1)) : ids_.end();
    if (id != ids_.end() && !wanted_[id->second]) return true;
    std::string why;
    if (id == ids_.end())
      why = "a message of a topic that is not listed";
    else if (!rows.is_integer(2))
      why = "a message whose time is no integer";
    else if (!rows.is_blob(3))
      why = "a message whose data is no blob";
    if (!why.empty()) return drop("W-DATABASE", why, where()), true;
    const Bytes data = plain_message(rows.blob(3), plain_, why);
    if (!why.empty()) return drop("W-MESSAGE", "a compressed message is damaged: " + why, where()), true;
    return deliver({id->second, rows.integer(2), data, static_cast<std::uint64_t>(rows.integer(0))});
  }

  SqliteFile file_;
  std::uint64_t bytes_;
  std::int64_t rows_ = 0;
  std::unordered_map<std::int64_t, std::size_t> ids_;
  std::vector<bool> wanted_;
  ByteBuffer plain_;
};

}  // namespace

std::unique_ptr<BagReader> open_db3(const std::string& path, const BagOptions& options) {
  const std::uint64_t bytes = Input::open(path).size();
  return std::make_unique<Db3Reader>(SqliteFile::open(path), bytes, options);
}

std::unique_ptr<BagReader> open_db3_bytes(std::string bytes, std::string name, const BagOptions& options) {
  const std::uint64_t size = bytes.size();
  return std::make_unique<Db3Reader>(SqliteFile::open_bytes(std::move(bytes), std::move(name)), size, options);
}

}  // namespace vispline

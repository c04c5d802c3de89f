#include "vispline/bags/sqlite_file.h"

#include <sqlite3.h>
#include <unistd.h>

#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <utility>

#include "vispline/bags/chunk_codec.h"

namespace vispline {
namespace {

/// Far more than the steps from one row to the next take; a loop in a crafted file ends here.
constexpr int kStepsPerCall = 100'000;
constexpr int kMaxCallsPerStep = 500;

[[noreturn]] void fail_sqlite(sqlite3* database, const std::string& name) {
  const int code = sqlite3_errcode(database);
  if (code == SQLITE_TOOBIG || code == SQLITE_NOMEM) fail_limit(name, "a value in the database is above 256 MiB");
  fail_database(name, code == SQLITE_INTERRUPT ? "reading a row takes too many steps" : sqlite3_errmsg(database));
}

/// Only SELECT and reading of columns of three tables and what those columns are; no functions, no other schema.
int authorize(void*, int action, const char* table, const char*, const char*, const char* trigger_or_view) {
  if (trigger_or_view != nullptr) return SQLITE_DENY;
  if (action == SQLITE_SELECT) return SQLITE_OK;
  if (action == SQLITE_PRAGMA && table == std::string_view("table_xinfo")) return SQLITE_OK;
  if (action != SQLITE_READ || table == nullptr) return SQLITE_DENY;
  for (const std::string_view allowed : {"topics", "messages", "sqlite_master", "sqlite_schema"}) {
    if (allowed == table) return SQLITE_OK;
  }
  return SQLITE_DENY;
}

int count_calls(void* calls) { return ++*static_cast<std::uint64_t*>(calls) > kMaxCallsPerStep ? 1 : 0; }

/// file: URI in which nothing of the path has a meaning of its own.
std::string uri_of(const std::string& path, const char* query) {
  static constexpr std::string_view kHex = "0123456789ABCDEF";
  std::string uri = "file:";
  for (const unsigned char c : std::filesystem::absolute(path).string()) {
    if (std::isalnum(c) != 0 || c == '/' || c == '.' || c == '_' || c == '-') {
      uri += static_cast<char>(c);
    } else {
      uri += {'%', kHex[c >> 4], kHex[c & 15]};
    }
  }
  return uri + query;
}

void copy_input(const Input& from, const std::string& to) {
  std::ofstream out(to, std::ios::binary);
  std::string piece(std::size_t{1} << 20, '\0');
  for (std::uint64_t done = 0; done < from.size();) {
    const std::size_t got = from.read_at(done, reinterpret_cast<std::byte*>(piece.data()), piece.size());
    if (got == 0) break;
    out.write(piece.data(), static_cast<std::streamsize>(got));
    done += got;
  }
  if (!out.flush()) fail_database(from.name(), "no room for a private copy of the database and its -wal file");
}

/// A folder only its owner can look into; removed with all in it.
class PrivateFolder {
 public:
  PrivateFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "vispline_XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) fail_database(name, "no private folder can be made");
    path_ = name;
  }
  ~PrivateFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;
  std::string path(const char* name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

bool has_wal(const std::string& path) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path + "-wal", error);
  return !error && size > 0;
}

/// The pages of the -wal file are taken over in the copy, which then stands alone.
void merge_wal(const std::string& copy, const std::string& name) {
  sqlite3* database = nullptr;
  bool good =
      sqlite3_open_v2(copy.c_str(), &database, SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOFOLLOW, nullptr) == SQLITE_OK;
  good = good && sqlite3_db_config(database, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr) == SQLITE_OK;
  good = good && sqlite3_db_config(database, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr) == SQLITE_OK;
  good =
      good && sqlite3_exec(database, "SELECT name FROM sqlite_master LIMIT 1", nullptr, nullptr, nullptr) == SQLITE_OK;
  good =
      good && sqlite3_wal_checkpoint_v2(database, nullptr, SQLITE_CHECKPOINT_TRUNCATE, nullptr, nullptr) == SQLITE_OK;
  const std::string why = good ? "" : sqlite3_errmsg(database);
  sqlite3_close(database);
  if (!good) fail_database(name, "its -wal file cannot be used: " + why);
}

}  // namespace

void fail_database(const std::string& where, const std::string& message) {
  throw Error(ExitCode::kInput, {.code = "E-DATABASE",
                                 .message = message,
                                 .where = where,
                                 .effect = "the database is not read",
                                 .next = "sqlite3 broken.db3 .recover | sqlite3 mended.db3 may save what is there"});
}

bool is_sqlite(const Input& input) { return input.head(16) == std::string_view("SQLite format 3\0", 16); }

SqliteFile SqliteFile::open(const std::string& path) {
  const Input input = Input::open(path);  // a regular file that can be read
  SqliteFile file;
  file.name_ = path;
  std::string target = path;
  std::unique_ptr<PrivateFolder> folder;
  if (has_wal(path)) {
    folder = std::make_unique<PrivateFolder>();
    target = folder->path("copy.db3");
    copy_input(input, target);
    copy_input(Input::open(path + "-wal"), target + "-wal");
    merge_wal(target, path);
    file.copied_ = true;
  }
  const int code = sqlite3_open_v2(uri_of(target, "?immutable=1&mode=ro").c_str(), &file.database_,
                                   SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
  if (code != SQLITE_OK) fail_sqlite(file.database_, path);
  file.harden();
  return file;  // an open copy lives on without its name
}

SqliteFile SqliteFile::open_bytes(std::string bytes, std::string name) {
  SqliteFile file;
  file.name_ = std::move(name);
  file.memory_ = std::make_unique<std::string>(std::move(bytes));
  if (sqlite3_open_v2(":memory:", &file.database_, SQLITE_OPEN_READWRITE, nullptr) != SQLITE_OK) {
    fail_sqlite(file.database_, file.name_);
  }
  const auto size = static_cast<sqlite3_int64>(file.memory_->size());
  if (sqlite3_deserialize(file.database_, "main", reinterpret_cast<unsigned char*>(file.memory_->data()), size, size,
                          SQLITE_DESERIALIZE_READONLY) != SQLITE_OK) {
    fail_sqlite(file.database_, file.name_);
  }
  file.harden();
  return file;
}

SqliteFile::~SqliteFile() { sqlite3_close(database_); }

SqliteFile::SqliteFile(SqliteFile&& other) noexcept
    : database_(std::exchange(other.database_, nullptr)),
      name_(std::move(other.name_)),
      memory_(std::move(other.memory_)),
      steps_(std::move(other.steps_)),
      copied_(other.copied_) {}

void SqliteFile::harden() {
  sqlite3_db_config(database_, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(database_, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(database_, SQLITE_DBCONFIG_ENABLE_LOAD_EXTENSION, 0, nullptr);
  sqlite3_db_config(database_, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
  sqlite3_db_config(database_, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
  sqlite3_limit(database_, SQLITE_LIMIT_LENGTH, static_cast<int>(kChunkBytes));
  sqlite3_limit(database_, SQLITE_LIMIT_SQL_LENGTH, 1 << 20);
  sqlite3_limit(database_, SQLITE_LIMIT_COLUMN, 100);
  sqlite3_limit(database_, SQLITE_LIMIT_EXPR_DEPTH, 100);
  sqlite3_limit(database_, SQLITE_LIMIT_ATTACHED, 0);
  sqlite3_exec(database_, "PRAGMA cell_size_check=ON; PRAGMA mmap_size=0;", nullptr, nullptr, nullptr);
  steps_ = std::make_unique<std::uint64_t>(0);
  sqlite3_progress_handler(database_, kStepsPerCall, count_calls, steps_.get());
  sqlite3_set_authorizer(database_, authorize, nullptr);
}

bool SqliteFile::has_table(const std::string& table) const {
  SqliteRows all = rows("SELECT type, name, rootpage FROM sqlite_master");
  bool found = false;
  while (all.next()) found = found || (all.text(0) == "table" && all.text(1) == table && all.integer(2) > 0);
  SqliteRows columns = rows("PRAGMA table_xinfo(" + table + ")");
  while (columns.next()) found = found && columns.integer(6) == 0;  // a generated column runs what a stranger wrote
  return found;
}

SqliteRows::SqliteRows(sqlite3* database, std::uint64_t* steps, const std::string& name, const std::string& select)
    : database_(database), steps_(steps), name_(name) {
  if (sqlite3_prepare_v2(database, select.c_str(), -1, &statement_, nullptr) != SQLITE_OK) fail_sqlite(database, name);
}

SqliteRows::~SqliteRows() { sqlite3_finalize(statement_); }

bool SqliteRows::next() {
  *steps_ = 0;
  const int code = sqlite3_step(statement_);
  if (code != SQLITE_ROW && code != SQLITE_DONE) fail_sqlite(database_, name_);
  return code == SQLITE_ROW;
}

bool SqliteRows::is_integer(int column) const { return sqlite3_column_type(statement_, column) == SQLITE_INTEGER; }
bool SqliteRows::is_text(int column) const { return sqlite3_column_type(statement_, column) == SQLITE_TEXT; }
bool SqliteRows::is_blob(int column) const { return sqlite3_column_type(statement_, column) == SQLITE_BLOB; }
std::int64_t SqliteRows::integer(int column) const { return sqlite3_column_int64(statement_, column); }

std::string SqliteRows::text(int column) const {
  const auto* text = sqlite3_column_text(statement_, column);
  if (text == nullptr) return "";
  return {reinterpret_cast<const char*>(text), static_cast<std::size_t>(sqlite3_column_bytes(statement_, column))};
}

Bytes SqliteRows::blob(int column) const {
  const void* blob = sqlite3_column_blob(statement_, column);
  if (blob == nullptr) return {};
  return {static_cast<const std::byte*>(blob), static_cast<std::size_t>(sqlite3_column_bytes(statement_, column))};
}

}  // namespace vispline

/// SQLite databases of strangers: read-only, no code of the schema runs, only two tables can be read.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "vispline/bags/bag.h"
#include "vispline/bags/input.h"

struct sqlite3;
struct sqlite3_stmt;

namespace vispline {

/// A prepared SELECT.
class SqliteRows {
 public:
  /// Throws E-DATABASE if the tables or columns are not there.
  SqliteRows(sqlite3* database, std::uint64_t* steps, const std::string& name, const std::string& select);
  ~SqliteRows();
  SqliteRows(const SqliteRows&) = delete;
  SqliteRows& operator=(const SqliteRows&) = delete;

  /// The next row; throws E-DATABASE for a damaged page and E-LIMIT for a value above 256 MiB.
  bool next();
  bool is_integer(int column) const;
  bool is_text(int column) const;
  bool is_blob(int column) const;
  std::int64_t integer(int column) const;
  std::string text(int column) const;
  /// Good until next().
  Bytes blob(int column) const;

 private:
  sqlite3* database_;
  std::uint64_t* steps_;
  std::string name_;
  sqlite3_stmt* statement_ = nullptr;
};

/// An open database, hardened. The file is never changed and no file beside it is made.
class SqliteFile {
 public:
  /// With a -wal file beside it that is not empty, both are copied to a private folder and `copied` says so.
  static SqliteFile open(const std::string& path);
  /// A whole database in memory.
  static SqliteFile open_bytes(std::string bytes, std::string name);
  ~SqliteFile();
  SqliteFile(SqliteFile&& other) noexcept;
  SqliteFile(const SqliteFile&) = delete;
  SqliteFile& operator=(const SqliteFile&) = delete;
  SqliteFile& operator=(SqliteFile&&) = delete;

  /// Whether an ordinary table, not a view or a virtual table, has that name and no generated columns. `table` is a
  /// plain word.
  bool has_table(const std::string& table) const;
  /// "SELECT ..."; anything but reading the tables topics and messages is refused.
  SqliteRows rows(const std::string& select) const { return {database_, steps_.get(), name_, select}; }
  bool copied() const { return copied_; }
  const std::string& name() const { return name_; }

 private:
  SqliteFile() = default;
  void harden();

  sqlite3* database_ = nullptr;
  std::string name_;
  std::unique_ptr<std::string> memory_;
  std::unique_ptr<std::uint64_t> steps_;  ///< since the last row
  bool copied_ = false;
};

/// E-DATABASE, exit 3.
[[noreturn]] void fail_database(const std::string& where, const std::string& message);

bool is_sqlite(const Input& input);

}  // namespace vispline

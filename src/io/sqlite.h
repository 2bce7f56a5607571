#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace medial::io {

/// What SQLite reports; thrown within this layer, and caught by write_gpkg().
struct SqliteFailure {
  std::string text;
};

/// A database being filled that is thrown away on failure: nothing is kept for a rollback. The file
/// of a path; one below /vsimem/ is worked on in memory and put back by finish().
class Database {
 public:
  explicit Database(const std::string& path);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  void run(const std::string& sql);
  /// The rows are on the disk.
  void finish();
  sqlite3* handle() { return handle_; }

 private:
  void open();
  std::string path_;
  sqlite3* handle_ = nullptr;
};

/// A prepared statement. Values are bound from column 1 on.
class Statement {
 public:
  Statement(Database& database, const std::string& sql);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  void bind(int at, std::int64_t value);
  void bind(int at, double value);
  void bind_null(int at);
  /// Texts and bytes stay where they are until the statement has run.
  void bind(int at, std::string_view text);
  void bind(int at, std::span<const std::uint8_t> bytes);
  /// The next row, if there is one.
  bool step();
  /// Runs to the end; ready for other values.
  void run();
  /// Of the row.
  std::int64_t whole(int column);
  std::string text(int column);

 private:
  void check(int code);
  Database& database_;
  sqlite3_stmt* handle_ = nullptr;
};

/// A name as SQL quotes it.
std::string quoted_name(std::string_view name);

}  // namespace medial::io

#pragma once

// SQLite's objects, which close by themselves.

#include <sqlite3.h>

#include <memory>

namespace medial::io {

struct CloseSqlite {
  /// The database itself is closed with the last of its statements and backups.
  void operator()(sqlite3* database) const { sqlite3_close_v2(database); }
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  void operator()(sqlite3_backup* backup) const { sqlite3_backup_finish(backup); }
};
using Database = std::unique_ptr<sqlite3, CloseSqlite>;
using Statement = std::unique_ptr<sqlite3_stmt, CloseSqlite>;
using Backup = std::unique_ptr<sqlite3_backup, CloseSqlite>;

}  // namespace medial::io

#include "io/gis/shared_database.h"

#include <fmt/format.h>

#include <utility>

#include "io/gis/sqlite.h"
#include "io/output.h"

namespace medial::io {

namespace {

Error unwritable(int code) {
  const int kind = code & 0xff;  // without the details
  if (kind == SQLITE_BUSY || kind == SQLITE_LOCKED)
    return Error{ErrorCode::unwritable,
                 "another program is using the file; try again when it is done, or write to a new "
                 "file",
                 {}};
  return Error{ErrorCode::unwritable,
               fmt::format("cannot add to what is there: {}", sqlite3_errstr(code)),
               {}};
}

Result<Database> open(const std::string& path, int flags) {
  constexpr int patience = 5000;  // milliseconds until others give way
  sqlite3* opened = nullptr;
  const int code = sqlite3_open_v2(path.c_str(), &opened, flags, nullptr);
  Database database(opened);
  if (code != SQLITE_OK) return unwritable(code);
  sqlite3_busy_timeout(opened, patience);
  return database;
}

/// A number that changes when another connection has changed the content.
unsigned version_of(sqlite3* database) {
  unsigned version = 0;
  sqlite3_file_control(database, "main", SQLITE_FCNTL_DATA_VERSION, &version);
  return version;
}

class SharedDatabase final : public Addition {
 public:
  static Result<std::unique_ptr<Addition>> begin(const std::string& path, const std::string& copy) {
    auto database = open(path, SQLITE_OPEN_READWRITE);
    if (!database) return std::move(database).error();
    if (sqlite3_db_readonly(database->get(), "main") != 0) return unwritable(SQLITE_READONLY);
    auto copied = open(copy, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
    if (!copied) return std::move(copied).error();
    Backup backup(sqlite3_backup_init(copied->get(), "main", database->get(), "main"));
    const int code =
        backup ? sqlite3_backup_step(backup.get(), -1) : sqlite3_extended_errcode(copied->get());
    if (code != SQLITE_DONE) return unwritable(code);
    backup.reset();
    const unsigned version = version_of(database->get());
    return std::unique_ptr<Addition>(
        std::make_unique<SharedDatabase>(std::move(*database), copy, version));
  }

  SharedDatabase(Database database, std::string copy, unsigned version)
      : database_(std::move(database)), copy_(std::move(copy)), version_(version) {}

  Status commit() override {
    auto copy = open(copy_, SQLITE_OPEN_READWRITE);
    if (!copy) return std::move(copy).error();
    Backup backup(sqlite3_backup_init(database_.get(), "main", copy->get(), "main"));
    if (!backup) return unwritable(sqlite3_extended_errcode(database_.get()));
    // A step of no pages locks the file: from here on, nobody else can change it.
    if (const int code = sqlite3_backup_step(backup.get(), 0); code != SQLITE_OK)
      return unwritable(code);
    const Uninterrupted uninterrupted;
    if (version_of(database_.get()) != version_) return changed_meanwhile();
    if (const int code = sqlite3_backup_step(backup.get(), -1); code != SQLITE_DONE)
      return unwritable(code);
    const int code = sqlite3_backup_finish(backup.release());
    return code == SQLITE_OK ? success() : Status(unwritable(code));
  }

 private:
  Database database_;
  std::string copy_;
  unsigned version_;
};

}  // namespace

Result<std::unique_ptr<Addition>> begin_addition_to_database(const std::string& path,
                                                             const std::string& copy) {
  return SharedDatabase::begin(path, copy);
}

}  // namespace medial::io

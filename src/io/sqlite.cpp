#include "io/sqlite.h"

#include <cpl_vsi.h>
#include <sqlite3.h>

#include <cstring>
#include <limits>

namespace medial::io {

namespace {

bool in_memory(const std::string& path) { return path.starts_with("/vsimem/"); }

}  // namespace

Database::Database(const std::string& path) : path_(path) {
  try {
    open();
  } catch (...) {
    sqlite3_close_v2(handle_);
    throw;
  }
}

void Database::open() {
  const char* file = in_memory(path_) ? ":memory:" : path_.c_str();
  const auto demand = [this](int code) {
    if (code != SQLITE_OK)
      throw SqliteFailure{handle_ == nullptr ? sqlite3_errstr(code) : sqlite3_errmsg(handle_)};
  };
  demand(sqlite3_open_v2(file, &handle_, SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX, nullptr));
  if (in_memory(path_)) {
    vsi_l_offset size = 0;
    const GByte* bytes = VSIGetMemFileBuffer(path_.c_str(), &size, FALSE);
    auto* own = static_cast<unsigned char*>(sqlite3_malloc64(size));
    if (bytes == nullptr || own == nullptr) throw SqliteFailure{"no memory for the database"};
    std::memcpy(own, bytes, size);
    const auto length = static_cast<sqlite3_int64>(size);
    demand(sqlite3_deserialize(handle_, "main", own, length, length,
                               SQLITE_DESERIALIZE_FREEONCLOSE | SQLITE_DESERIALIZE_RESIZEABLE));
    sqlite3_int64 limit = std::numeric_limits<sqlite3_int64>::max();
    sqlite3_file_control(handle_, "main", SQLITE_FCNTL_SIZE_LIMIT, &limit);
  }
  run("PRAGMA journal_mode=OFF; PRAGMA synchronous=OFF; PRAGMA locking_mode=EXCLUSIVE; "
      "PRAGMA cache_size=-65536; BEGIN");
}

Database::~Database() { sqlite3_close_v2(handle_); }

void Database::run(const std::string& sql) {
  if (sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
    throw SqliteFailure{sqlite3_errmsg(handle_)};
}

void Database::finish() {
  run("COMMIT");
  if (!in_memory(path_)) return;
  sqlite3_int64 size = 0;
  const unsigned char* bytes = sqlite3_serialize(handle_, "main", &size, SQLITE_SERIALIZE_NOCOPY);
  VSILFILE* file = VSIFOpenL(path_.c_str(), "wb");
  const bool written = file != nullptr && bytes != nullptr &&
                       VSIFWriteL(bytes, static_cast<std::size_t>(size), 1, file) == 1;
  if (file != nullptr) VSIFCloseL(file);
  if (!written) throw SqliteFailure{"no memory for the database"};
}

Statement::Statement(Database& database, const std::string& sql) : database_(database) {
  check(sqlite3_prepare_v3(database_.handle(), sql.c_str(), -1, SQLITE_PREPARE_PERSISTENT, &handle_,
                           nullptr));
}

Statement::~Statement() { sqlite3_finalize(handle_); }

void Statement::check(int code) {
  if (code != SQLITE_OK) throw SqliteFailure{sqlite3_errmsg(database_.handle())};
}

void Statement::bind(int at, std::int64_t value) { check(sqlite3_bind_int64(handle_, at, value)); }

void Statement::bind(int at, double value) { check(sqlite3_bind_double(handle_, at, value)); }

void Statement::bind_null(int at) { check(sqlite3_bind_null(handle_, at)); }

void Statement::bind(int at, std::string_view text) {
  check(sqlite3_bind_text64(handle_, at, text.data(), text.size(), SQLITE_STATIC, SQLITE_UTF8));
}

void Statement::bind(int at, std::span<const std::uint8_t> bytes) {
  check(sqlite3_bind_blob64(handle_, at, bytes.data(), bytes.size(), SQLITE_STATIC));
}

bool Statement::step() {
  const int code = sqlite3_step(handle_);
  if (code != SQLITE_ROW && code != SQLITE_DONE) check(code);
  return code == SQLITE_ROW;
}

void Statement::run() {
  while (step()) {
  }
  check(sqlite3_reset(handle_));
}

std::int64_t Statement::whole(int column) { return sqlite3_column_int64(handle_, column); }

std::string Statement::text(int column) {
  const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(handle_, column));
  return bytes == nullptr ? std::string() : std::string(bytes);
}

std::string quoted_name(std::string_view name) {
  std::string out = "\"";
  for (const char c : name) {
    out += c;
    if (c == '"') out += c;
  }
  return out + '"';
}

}  // namespace medial::io

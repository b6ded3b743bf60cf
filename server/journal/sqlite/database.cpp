#include "server/journal/sqlite/database.hpp"

#include <fcntl.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>

#include "server/journal/sqlite/statement.hpp"

namespace genio {
namespace {

constexpr int busy_wait_ms = 5000;       // other programs write for some milliseconds
constexpr int largest_value = 64 << 20;  // [bytes]; a damaged length must not fill the memory

/// As a URI, in which SQLite takes some signs for others.
std::string immutable_uri(const std::string& path) {
  std::string uri = "file:";
  for (const char c : path) {
    if (c == '%') uri += "%25";
    else if (c == '?') uri += "%3f";
    else if (c == '#') uri += "%23";
    else uri += c;
  }
  return uri + "?immutable=1";
}

/// SQLite would let other users read the file, and hold locks on it. The files that it makes beside
/// have the same mode. Only of a new file: closing one that is there would end this process's locks
/// on it.
void make_private(const std::string& path) {
  const int fd = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, S_IRUSR | S_IWUSR);
  if (fd >= 0) close(fd);
}

}  // namespace

void Database::Close::operator()(sqlite3* db) const { sqlite3_close(db); }

Database::Database(const std::string& path, Open how) {
  if (how == Open::created && path != ":memory:") make_private(path);
  sqlite3* db = nullptr;
  const bool immutable = how == Open::immutable;
  const int flags = SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_EXRESCODE |
                    (immutable ? SQLITE_OPEN_READONLY | SQLITE_OPEN_URI : SQLITE_OPEN_READWRITE) |
                    (how == Open::created ? SQLITE_OPEN_CREATE : 0);
  const int code =
      sqlite3_open_v2((immutable ? immutable_uri(path) : path).c_str(), &db, flags, nullptr);
  handle_.reset(db);
  if (code != SQLITE_OK) throw_storage_error(code, db);
  sqlite3_busy_timeout(db, busy_wait_ms);
  sqlite3_limit(db, SQLITE_LIMIT_LENGTH, largest_value);
  sqlite3_limit(db, SQLITE_LIMIT_ATTACHED, 0);
  // A schema that somebody else wrote must not run anything.
  sqlite3_db_config(db, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(db, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
}

void Database::run(const std::string& sql) {
  const int code = sqlite3_exec(handle(), sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) throw_storage_error(code, handle());
}

int64_t Database::number(const char* sql) const {
  Statement statement(*this, sql);
  const auto row = statement();
  return row.next() ? row.integer(0) : 0;
}

std::string Database::text(const char* sql) const {
  Statement statement(*this, sql);
  const auto row = statement();
  return row.next() ? row.text(0) : "";
}

bool Database::in_transaction() const { return sqlite3_get_autocommit(handle()) == 0; }

void Database::roll_back() noexcept {
  if (in_transaction()) sqlite3_exec(handle(), "ROLLBACK", nullptr, nullptr, nullptr);
}

}  // namespace genio

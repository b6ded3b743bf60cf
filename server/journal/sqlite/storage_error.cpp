#include "server/journal/sqlite/storage_error.hpp"

#include <sqlite3.h>

#include <cerrno>
#include <cstring>

namespace genio {
namespace {

StorageError::Kind kind_of(int code) {
  switch (code & 0xff) {
    case SQLITE_CORRUPT:
    case SQLITE_TOOBIG:  // no entry that the journal wrote is too large to be read
      return StorageError::Kind::damaged;
    case SQLITE_NOTADB:
      return StorageError::Kind::foreign;
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return StorageError::Kind::busy;
    case SQLITE_CANTOPEN:
      return StorageError::Kind::unopened;
    default:
      return StorageError::Kind::failed;
  }
}

std::string words_of(int code, int system_error, const std::string& message) {
  switch (kind_of(code)) {
    case StorageError::Kind::damaged:
      return "is damaged: " + message;
    case StorageError::Kind::foreign:
      return "is no journal of Genio";
    case StorageError::Kind::busy:
      return "is in use by another program";
    default:
      break;
  }
  const std::string reason = system_error ? std::strerror(system_error) : message;
  switch (code & 0xff) {
    case SQLITE_CANTOPEN:
      return "cannot be opened: " + reason;
    case SQLITE_FULL:
      return std::string("cannot be written: ") + std::strerror(ENOSPC);
    case SQLITE_READONLY:
    case SQLITE_PERM:
      return "cannot be written: " + message;
    case SQLITE_IOERR:
      return "cannot be read or written: " + reason;
    default:
      return "cannot be used: " + message;
  }
}

}  // namespace

StorageError::StorageError(int code, int system_error, const std::string& message)
    : std::runtime_error(words_of(code, system_error, message)), kind_(kind_of(code)) {}

void throw_storage_error(int code, sqlite3* db) {
  if (!db) throw StorageError(code, 0, sqlite3_errstr(code));
  throw StorageError(sqlite3_extended_errcode(db), sqlite3_system_errno(db), sqlite3_errmsg(db));
}

}  // namespace genio

#include "server/journal/sqlite/file_lock.hpp"

namespace genio {

FileLock::FileLock(const std::string& path) {
  if (path == ":memory:") return;
  try {
    lock_.emplace(path + ".lock", Database::Open::created);
    // SQLite's locks are those of POSIX, and hold within one process as well. It never writes here,
    // and waits for nobody.
    lock_->run("PRAGMA busy_timeout = 0; PRAGMA journal_mode = MEMORY; BEGIN EXCLUSIVE");
  } catch (const StorageError& e) {
    if (e.kind() == StorageError::Kind::busy)
      throw StorageError(e.kind(), "is in use by another server");
    throw StorageError(e.kind(),
                       "cannot be locked by means of " + path + ".lock, which " + e.what());
  }
}

}  // namespace genio

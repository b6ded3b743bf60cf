#include "server/journal/open_journal.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "server/journal/schema.hpp"

namespace genio {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_journal(const std::string& why,
                                 StorageError::Kind kind = StorageError::Kind::failed) {
  throw StorageError(kind, why);
}

/// Also true for a link that leads nowhere.
bool is_there(const std::string& path) {
  std::error_code none;
  return fs::exists(fs::symlink_status(path, none));
}

void check_is_file(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) refuse_journal("no such file");
  if (status.type() == fs::file_type::none) refuse_journal("cannot be read: " + error.message());
  if (status.type() == fs::file_type::directory) refuse_journal("is a folder; expected a journal");
  if (status.type() != fs::file_type::regular)
    refuse_journal("is a pipe or a device; expected a journal");
  // SQLite takes it for a new database, and forgets the write-ahead log.
  if (fs::file_size(path, error) == 0)
    refuse_journal("is empty; expected a journal. Remove it to begin a new one",
                   StorageError::Kind::damaged);
}

/// A name that was just given is on disk too.
void sync_folder_of(const std::string& path) {
  const int folder = open(fs::path(path).parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;  // a folder that may be written, but not read
  fsync(folder);
  close(folder);
}

/// Under another name first, so that nobody ever sees half of a new journal.
void create_journal(const std::string& path) {
  const std::string log = path + "-wal", fresh = path + ".new";
  std::error_code error;
  if (fs::exists(log, error))
    refuse_journal("is gone, but its write-ahead log is there: put the journal back, or remove " +
                   log);
  for (const char* ending : {"", "-wal", "-shm", "-journal"}) fs::remove(fresh + ending, error);
  {
    Database db(fresh, Database::Open::created);
    db.run("PRAGMA auto_vacuum = INCREMENTAL; PRAGMA synchronous = FULL");
    bring_up_to_date(db, journal_steps());
    if (db.text("PRAGMA journal_mode = WAL") != "wal")
      refuse_journal("stands on a file system without shared memory, which SQLite's WAL needs");
  }
  fs::rename(fresh, path, error);
  if (error) refuse_journal("cannot be written: " + error.message());
  sync_folder_of(path);
}

void check_structure(const Database& db) {
  check_tables(db, journal_steps());
  if (const std::string found = db.text("PRAGMA integrity_check(1)"); found != "ok")
    refuse_journal("is damaged: " + found, StorageError::Kind::damaged);
}

/// SQLite says less of the reason, and opens what may not be written to read it.
void check_may_write(const std::string& path) {
  const auto refused = [](const char* name) {
    return faccessat(AT_FDCWD, name, W_OK, AT_EACCESS) != 0;
  };
  if (refused(fs::path(path).parent_path().c_str()))
    refuse_journal(std::string("stands in a folder that cannot be written: ") +
                   std::strerror(errno));
  if (is_there(path) && refused(path.c_str()))
    refuse_journal(std::string("cannot be written: ") + std::strerror(errno));
}

/// A page is judged before it is believed, and a deletion is not written as zeros as well.
constexpr const char* careful =
    "PRAGMA cell_size_check = ON; PRAGMA secure_delete = OFF; PRAGMA synchronous = FULL;";

}  // namespace

std::string journal_path(const std::string& path) {
  if (path == ":memory:") return path;
  if (path.empty()) refuse_journal("no name of a file is given");
  if (path.find('\0') != std::string::npos)
    refuse_journal("holds a NUL byte; expected the name of a file");
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(fs::absolute(path, error), error);
  if (error) refuse_journal("cannot be opened: " + error.message());
  return canonical.string();
}

void check_is_journal(const std::string& path) {
  if (path == ":memory:") return;
  const bool there = is_there(path);
  if (there) check_is_file(path);
  check_may_write(path);
  if (!there) return;
  check_version(Database(path, Database::Open::existing), journal_steps(), false);
}

Database open_own_journal(const std::string& path) {
  const bool in_memory = path == ":memory:";
  if (!in_memory && !is_there(path)) create_journal(path);
  if (!in_memory) check_is_file(path);
  Database db(path, in_memory ? Database::Open::created : Database::Open::existing);
  if (in_memory) bring_up_to_date(db, journal_steps());
  check_version(db, journal_steps(), false);
  db.run(careful);
  bring_up_to_date(db, journal_steps());
  if (!in_memory && db.text("PRAGMA journal_mode = WAL") != "wal")
    refuse_journal("cannot be set to a write-ahead log");
  // All of a transaction stays in memory until it is committed, which alone may fail for want of
  // room. The log is cut back after a long transaction [bytes].
  db.run("PRAGMA cache_spill = OFF; PRAGMA journal_size_limit = 8000000");
  check_structure(db);
  return db;
}

Database open_to_read(const std::string& path) {
  check_is_file(path);
  const auto checked = [&](Database::Open how) {
    Database db(path, how);
    db.run(std::string(careful) + "PRAGMA query_only = ON;");
    check_version(db, journal_steps(), true);
    return db;
  };
  try {
    return checked(Database::Open::existing);
  } catch (const StorageError& e) {
    // SQLite makes files beside, which a folder may not allow. Without a log they are not needed.
    std::error_code none;
    const bool denied =
        e.kind() == StorageError::Kind::unopened || e.kind() == StorageError::Kind::failed;
    if (!denied || fs::exists(path + "-wal", none)) throw;
    return checked(Database::Open::immutable);
  }
}

Database open_to_prune(const std::string& path) {
  check_is_file(path);
  check_may_write(path);
  Database db(path, Database::Open::existing);
  db.run(careful);
  check_version(db, journal_steps(), true);
  check_structure(db);
  return db;
}

}  // namespace genio

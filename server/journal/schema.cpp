#include "server/journal/schema.hpp"

#include <fmt/format.h>

namespace genio {
namespace {

// Texts are blobs: they come from the network and need not be Unicode. Requests and replies stand
// apart, so that lists do not read them and a change of state does not write them again.
constexpr const char* version_1 = R"(
CREATE TABLE entry (
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  id BLOB NOT NULL UNIQUE,
  client BLOB NOT NULL,
  digest BLOB NOT NULL,
  model BLOB NOT NULL,
  stream BLOB NOT NULL,
  priority INTEGER NOT NULL,
  deadline_us INTEGER NOT NULL,
  accepted_us INTEGER NOT NULL,
  request_bytes INTEGER NOT NULL,
  state INTEGER NOT NULL,
  tries INTEGER NOT NULL,
  answered_us INTEGER NOT NULL,
  delivered_us INTEGER NOT NULL,
  status BLOB NOT NULL,
  reply_bytes INTEGER NOT NULL,
  checksum INTEGER NOT NULL
) STRICT;
CREATE INDEX entry_by_state ON entry (state, answered_us);
CREATE TABLE request (
  number INTEGER PRIMARY KEY,
  bytes BLOB NOT NULL,
  checksum INTEGER NOT NULL
) STRICT;
CREATE TABLE reply (
  number INTEGER PRIMARY KEY,
  bytes BLOB NOT NULL,
  checksum INTEGER NOT NULL
) STRICT;
)";

constexpr const char* steps_so_far[] = {version_1};

std::string tables_of(const Database& db) {
  return db.text(
      "SELECT group_concat(sql, ';') FROM (SELECT sql FROM sqlite_schema ORDER BY name)");
}

}  // namespace

std::span<const char* const> journal_steps() { return steps_so_far; }

int64_t journal_version() { return int64_t(journal_steps().size()); }

void bring_up_to_date(Database& db, std::span<const char* const> steps) {
  const auto version = size_t(db.number("PRAGMA user_version"));
  if (version >= steps.size()) return;
  Transaction transaction(db);
  for (const char* step : steps.subspan(version)) db.run(step);
  db.run(fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {}", journal_application,
                     steps.size()));
  transaction.commit();
}

void check_version(const Database& db, std::span<const char* const> steps, bool exactly) {
  if (db.number("PRAGMA application_id") != journal_application)
    throw StorageError(StorageError::Kind::foreign, "is no journal of Genio");
  const int64_t version = db.number("PRAGMA user_version"), known = int64_t(steps.size());
  if (version > known)
    throw StorageError(StorageError::Kind::foreign,
                       fmt::format("was written by a later version of Genio (form {}; this one "
                                   "knows forms up to {})",
                                   version, known));
  if (version < 1)
    throw StorageError(StorageError::Kind::damaged, fmt::format("is damaged: form {}", version));
  if (exactly && version < known)
    throw StorageError(StorageError::Kind::foreign,
                       fmt::format("was written by an earlier version of Genio (form {}); genio "
                                   "serve --journal brings it up to date",
                                   version));
}

void check_tables(const Database& db, std::span<const char* const> steps) {
  Database fresh(":memory:", Database::Open::created);
  bring_up_to_date(fresh, steps);
  if (tables_of(db) != tables_of(fresh))
    throw StorageError(StorageError::Kind::damaged, "is damaged: its tables are not a journal's");
}

}  // namespace genio

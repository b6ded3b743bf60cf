#pragma once
#include "server/journal/limits.hpp"
#include "server/journal/table.hpp"

namespace genio {

JournalCounts counts_of(const Database& db, JournalTable& table);

/// Bytes of the file that hold something, and those that do not.
int64_t used_bytes(const Database& db);
int64_t free_bytes(const Database& db);

/// True where the rule takes something away.
bool has_prunable(const Database& db, JournalTable& table, const PruneRule& rule);

/// Takes away up to `most` entries, in the caller's transaction: another program may remove entries
/// too, but none can meanwhile. Throws StorageError.
Pruned prune_some(Database& db, JournalTable& table, const PruneRule& rule, int most);

/// Gives room that no entry uses back to the file system, up to `most` bytes. The file is shorter
/// once the write-ahead log was written back.
void give_back(Database& db, int64_t most);

}  // namespace genio

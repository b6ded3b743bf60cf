#pragma once
#include <string>

#include "server/journal/sqlite/database.hpp"

namespace genio {

/// The path by which SQLite and its locks know a journal, whatever links lead to it. ":memory:"
/// stays as it is. Throws StorageError for what names no file.
std::string journal_path(const std::string& path);

/// Throws StorageError where something else than a journal of this version or an earlier one stands
/// at the path.
void check_is_journal(const std::string& path);

/// Opens a journal for its server, which owns it: makes it where there is none, brings one of an
/// earlier version up to date, and sets it so that what is committed is on disk. `path` as
/// journal_path() gives it. Throws StorageError, also where the structure of the file is damaged.
Database open_own_journal(const std::string& path);

/// Opens a journal that somebody else may own, to read it. Throws StorageError.
Database open_to_read(const std::string& path);

/// The same, to remove entries from it. Throws StorageError, also where the structure of the file
/// is damaged.
Database open_to_prune(const std::string& path);

}  // namespace genio

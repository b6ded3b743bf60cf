#pragma once
// The form of the file, which has a version.

#include <cstdint>
#include <span>

#include "server/journal/sqlite/database.hpp"

namespace genio {

/// "GENJ": what the file says it is.
inline constexpr int64_t journal_application = 0x47454e4a;

/// The k-th brings a journal of version k to version k + 1; a new file is of version 0. A change
/// of the form is one more of them, and none that was ever released changes.
std::span<const char* const> journal_steps();

/// The version that this program writes.
int64_t journal_version();

/// Takes the steps that a file lacks, all or none. Throws StorageError.
void bring_up_to_date(Database& db, std::span<const char* const> steps);

/// Throws StorageError unless the file says that it is a journal of at most the version that
/// `steps` lead to; of just that version where `exactly`.
void check_version(const Database& db, std::span<const char* const> steps, bool exactly);

/// Throws StorageError where the tables are not those that the steps make.
void check_tables(const Database& db, std::span<const char* const> steps);

}  // namespace genio

#pragma once
// A journal in words and as JSON.

#include <string>

#include "server/journal/entry.hpp"
#include "server/journal/limits.hpp"

namespace genio {

/// Columns parted by tabs, with the line that names them.
std::string list_header();
std::string list_line(const JournalEntry& entry, const std::string& damage);
std::string counts_line(const JournalCounts& counts);
/// One JSON object on one line. Bytes that are no UTF-8 become the replacement sign.
std::string entry_json(const JournalEntry& entry, const std::string& damage);

/// What was removed, and what is left.
std::string pruned_line(const Pruned& pruned, const JournalCounts& left);
std::string pruned_json(const Pruned& pruned, const JournalCounts& left);

}  // namespace genio

#pragma once
// A journal in words and as JSON.

#include <string>

#include "server/journal/entry.hpp"
#include "server/journal/limits.hpp"

namespace genio {

/// ISO 8601 in UTC with `digits` of the second's fraction, 3 or 6; "-" for 0, which is no time.
/// Times outside the years 0 to 9999 are given as their number.
std::string utc_text(int64_t us_since_1970, int digits);

/// Bytes that a terminal or a reader might take amiss as \xNN: controls, what is no UTF-8, and
/// signs that turn the direction of writing; the backslash as two.
std::string escaped_text(const std::string& bytes);

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

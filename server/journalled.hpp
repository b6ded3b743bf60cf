#pragma once
// A dispatcher's records in a journal.

#include "server/dispatch/record.hpp"
#include "server/journal/journal.hpp"
#include "server/journal/journal_view.hpp"

namespace genio {

/// What stands on the disk of an id; nothing where the id was never used. An entry that is damaged
/// counts as unknown.
std::optional<KnownRequest> known_request(const JournalView& journal, const std::string& id);

/// Of an entry that was accepted and not answered.
AcceptedRecord accepted_record(const JournalEntry& entry);

/// A request that the journal could not keep, and why.
struct Unkept {
  std::string id, reason;
};

/// Writes the records, as one transaction where nothing goes wrong, and waits until they stand on
/// the disk. Requests that cannot be kept are given back; other records are tried again with the
/// next ones.
std::vector<Unkept> write_records(Journal& journal, const std::vector<Record>& records,
                                  int64_t now_us);

}  // namespace genio

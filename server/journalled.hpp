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

/// With all its times later by `by_us`; no deadline stays none. A journal has the times of
/// now_us(), and a dispatcher those of process_us(), which differ by wall_lead_us().
AcceptedRecord later(AcceptedRecord record, int64_t by_us);

/// A request that the journal could not keep, and why.
struct Unkept {
  std::string id, reason;
};

/// What became of records.
struct RecordsWritten {
  std::vector<Unkept> unkept;
  std::vector<Record> put_off;  ///< to be written before the next ones
  std::string failure;          ///< why something was not written; empty: nothing failed
};

/// Writes the records, as one transaction where nothing goes wrong, and waits until they stand on
/// the disk. Requests that cannot be kept are given back; other records are tried again with the
/// next ones. Where another program writes it is waited for once, whatever their number.
RecordsWritten write_records(Journal& journal, std::vector<Record> records, int64_t now_us);

}  // namespace genio

#include "server/journalled.hpp"

#include <algorithm>
#include <utility>

#include "forward/base/types.hpp"
#include "server/wire/wire.hpp"

namespace genio {
namespace {

JournalEntry entry_of(const AcceptedRecord& r) {
  JournalEntry entry;
  entry.id = r.id, entry.client = r.client, entry.request = r.request;
  entry.accepted_us = r.accepted, entry.deadline_us = r.deadline;
  entry.model = r.model, entry.stream = r.stream, entry.priority = r.priority;
  std::copy_n(r.digest.begin(), std::min(r.digest.size(), entry.digest.size()),
              entry.digest.begin());
  return entry;
}

std::string text_of(const ContentDigest& digest) { return {digest.begin(), digest.end()}; }

/// Writes one record; what became of a request that it brings is empty, or why it is not kept.
struct Writer {
  Journal& journal;
  int64_t now;

  std::string operator()(const AcceptedRecord& r) const {
    switch (journal.accept(entry_of(r))) {
      case Acceptance::full:
        return "the journal is full of requests that are not answered yet; ask again later";
      case Acceptance::other:
        return "the id was used for another request; choose an id that is new";
      case Acceptance::fresh:
      case Acceptance::again:
        break;
    }
    return "";
  }
  std::string operator()(const LostRecord& r) const { return journal.tried(r.id), ""; }
  std::string operator()(const AnsweredRecord& r) const {
    return journal.answered(r.id, r.reply, r.status, now), "";
  }
  std::string operator()(const DeliveredRecord& r) const {
    return journal.delivered(r.id, now, r.client), "";
  }
};

/// Writes one batch of records.
class BatchWriter {
 public:
  BatchWriter(Journal& journal, int64_t now_us) : journal_(journal), now_(now_us) {}

  RecordsWritten write(std::vector<Record> records) {
    attempt([&] { journal_.begin(); });
    for (Record& record : records)
      if (busy_) put_off(std::move(record));
      else write(record);
    if (!busy_) attempt([&] { journal_.sync(); });
    return std::move(written_);
  }

 private:
  template <class F>
  bool attempt(F&& work) {
    try {
      work();
      return true;
    } catch (const JournalError& e) {
      busy_ = e.busy(), written_.failure = e.what();
      for (const std::string& id : e.refused()) written_.unkept.push_back({id, cannot_be_kept()});
      return false;
    }
  }
  void write(const Record& record) {
    const auto* accepted = std::get_if<AcceptedRecord>(&record);
    std::string reason;
    if (!attempt([&] { reason = std::visit(Writer{journal_, now_}, record); }))
      reason = cannot_be_kept();
    if (accepted && !reason.empty()) written_.unkept.push_back({accepted->id, reason});
  }
  void put_off(Record record) {
    if (const auto* accepted = std::get_if<AcceptedRecord>(&record))
      written_.unkept.push_back({accepted->id, cannot_be_kept()});
    else written_.put_off.push_back(std::move(record));
  }
  std::string cannot_be_kept() const { return "the request cannot be kept: " + written_.failure; }

  Journal& journal_;
  const int64_t now_;
  RecordsWritten written_;
  bool busy_ = false;
};

}  // namespace

std::optional<KnownRequest> known_request(const JournalView& journal, const std::string& id) try {
  const auto entry = journal.find(id);
  if (!entry) return {};
  return KnownRequest{text_of(entry->digest), entry->reply};
} catch (const InputError&) {
  return {};
}

AcceptedRecord accepted_record(const JournalEntry& e) {
  return {e.id,          e.client, text_of(e.digest), e.request, e.accepted_us,
          e.deadline_us, e.model,  e.stream,          e.priority};
}

AcceptedRecord later(AcceptedRecord record, int64_t by_us) {
  record.accepted += by_us;
  if (record.deadline > 0) record.deadline = std::max<int64_t>(1, record.deadline + by_us);
  return record;
}

RecordsWritten write_records(Journal& journal, std::vector<Record> records, int64_t now_us) {
  return BatchWriter(journal, now_us).write(std::move(records));
}

}  // namespace genio

#include "server/journalled.hpp"

#include <algorithm>

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
    return journal.delivered(r.id, now), "";
  }
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

std::vector<Unkept> write_records(Journal& journal, const std::vector<Record>& records,
                                  int64_t now_us) {
  std::vector<Unkept> unkept;
  const auto told = [&](const JournalError& e) {
    for (const std::string& id : e.refused())
      unkept.push_back({id, std::string("the request cannot be kept: ") + e.what()});
  };
  for (const Record& record : records) {
    const auto* accepted = std::get_if<AcceptedRecord>(&record);
    try {
      const std::string reason = std::visit(Writer{journal, now_us}, record);
      if (accepted && !reason.empty()) unkept.push_back({accepted->id, reason});
    } catch (const JournalError& e) {
      told(e);
      if (accepted)
        unkept.push_back({accepted->id, std::string("the request cannot be kept: ") + e.what()});
    }
  }
  try {
    journal.sync();
  } catch (const JournalError& e) {
    told(e);
  }
  return unkept;
}

}  // namespace genio

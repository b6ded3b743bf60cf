#include "server/journal/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "server/journal/sqlite/checksum.hpp"

namespace genio {
namespace {

// In the order in which read_entry() takes them.
const char* const select_entry =
    "SELECT number, id, client, digest, model, stream, priority, deadline_us, accepted_us, "
    "request_bytes, state, tries, answered_us, delivered_us, status, reply_bytes, checksum "
    "FROM entry ";

std::string entries(const char* where) { return std::string(select_entry) + where; }

/// Of everything but the number, which comes later; the blobs have checksums of their own.
int64_t checksum_of(const JournalEntry& e) {
  Checksum sum;
  sum.add(e.id).add(e.client).add(e.digest).add(e.model).add(e.stream).add(e.priority);
  sum.add(e.deadline_us).add(e.accepted_us).add(e.request_bytes).add(int64_t(e.state)).add(e.tries);
  sum.add(e.answered_us).add(e.delivered_us).add(e.status).add(e.reply_bytes);
  return sum.value();
}

/// With the id and the part, so that no other blob of the file passes for this one.
enum class Part { request, reply };
int64_t checksum_of(const JournalEntry& e, Part part, const std::vector<uint8_t>& blob) {
  return Checksum().add(e.id).add(int64_t(part)).add(blob).value();
}

JournalTable::Read read_entry(const Statement::Run& row) {
  JournalEntry e;
  e.number = row.integer(0), e.id = row.text(1), e.client = row.text(2);
  const auto digest = row.bytes(3);
  if (digest.size() == e.digest.size()) std::copy(digest.begin(), digest.end(), e.digest.begin());
  e.model = row.text(4), e.stream = row.text(5);
  e.priority = int(row.integer(6));
  e.deadline_us = row.integer(7), e.accepted_us = row.integer(8), e.request_bytes = row.integer(9);
  e.state = JournalState(row.integer(10)), e.tries = int(row.integer(11));
  e.answered_us = row.integer(12), e.delivered_us = row.integer(13);
  e.status = row.text(14), e.reply_bytes = row.integer(15);
  const bool whole = checksum_of(e) == row.integer(16);
  return {std::move(e), whole};
}

[[noreturn]] void refuse_damaged(const JournalEntry& entry, const char* part) {
  throw StorageError(StorageError::Kind::damaged,
                     fmt::format("is damaged: {} of '{}' (entry {}) differs from its checksum",
                                 part, entry.id, entry.number));
}

JournalEntry whole_entry(const Statement::Run& row) {
  JournalTable::Read read = read_entry(row);
  if (!read.whole) refuse_damaged(read.entry, "the row");
  return std::move(read.entry);
}

}  // namespace

JournalTable::JournalTable(const Database& db)
    : insert_(db,
              "INSERT INTO entry (id, client, digest, model, stream, priority, deadline_us, "
              "accepted_us, request_bytes, state, tries, answered_us, delivered_us, status, "
              "reply_bytes, checksum) "
              "VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, 0, 0, 0, 0, x'', 0, ?10) "
              "RETURNING number"),
      update_(db,
              "UPDATE entry SET state = ?2, tries = ?3, answered_us = ?4, delivered_us = ?5, "
              "status = ?6, reply_bytes = ?7, checksum = ?8 WHERE number = ?1"),
      find_(db, entries("WHERE id = ?1")),
      at_(db, "SELECT 1 FROM entry WHERE number = ?1"),
      unanswered_(db, entries("WHERE state = 0 ORDER BY number")),
      after_(db, entries("WHERE number > ?1 ORDER BY number LIMIT ?2")),
      oldest_(db,
              "SELECT number, request_bytes + reply_bytes FROM entry "
              "WHERE state = ?1 AND answered_us < ?2 ORDER BY answered_us, number LIMIT ?3"),
      count_(db, "SELECT count(*) FROM entry WHERE state = ?1"),
      unanswered_bytes_(db, "SELECT sum(request_bytes) FROM entry WHERE state = 0"),
      insert_request_(db, "INSERT INTO request (number, bytes, checksum) VALUES (?1, ?2, ?3)"),
      insert_reply_(db, "INSERT INTO reply (number, bytes, checksum) VALUES (?1, ?2, ?3)"),
      request_(db, "SELECT bytes, checksum FROM request WHERE number = ?1"),
      reply_(db, "SELECT bytes, checksum FROM reply WHERE number = ?1"),
      remove_(db, "DELETE FROM entry WHERE number = ?1 AND state > 0 RETURNING number"),
      remove_request_(db, "DELETE FROM request WHERE number = ?1"),
      remove_reply_(db, "DELETE FROM reply WHERE number = ?1") {}

void JournalTable::insert(const JournalEntry& entry) {
  JournalEntry e = entry;
  e.state = JournalState::accepted, e.tries = 0, e.answered_us = 0, e.delivered_us = 0;
  e.status.clear(), e.reply_bytes = 0, e.request_bytes = int64_t(e.request.size());
  {
    const auto row = insert_(e.id, e.client, e.digest, e.model, e.stream, e.priority, e.deadline_us,
                             e.accepted_us, e.request_bytes, checksum_of(e));
    if (row.next()) e.number = row.integer(0);
    row.next();
  }
  insert_request_.run(e.number, e.request, checksum_of(e, Part::request, e.request));
}

void JournalTable::update(const JournalEntry& e) {
  update_.run(e.number, int64_t(e.state), e.tries, e.answered_us, e.delivered_us, e.status,
              e.reply_bytes, checksum_of(e));
}

void JournalTable::update_with_reply(const JournalEntry& entry) {
  JournalEntry e = entry;
  e.reply_bytes = int64_t(e.reply.size());
  update(e);
  insert_reply_.run(e.number, e.reply, checksum_of(e, Part::reply, e.reply));
}

bool JournalTable::remove(int64_t number) {
  {
    const auto row = remove_(number);
    if (!row.next()) return false;
    row.next();
  }
  remove_request_.run(number);
  remove_reply_.run(number);
  return true;
}

std::optional<JournalEntry> JournalTable::find(const std::string& id) {
  const auto row = find_(id);
  if (!row.next()) return std::nullopt;
  return whole_entry(row);
}

std::vector<JournalEntry> JournalTable::unanswered() {
  std::vector<JournalEntry> result;
  const auto row = unanswered_();
  while (row.next()) result.push_back(whole_entry(row));
  return result;
}

bool JournalTable::load(JournalEntry& e) {
  const char* missing = nullptr;
  bool request_whole = true, reply_whole = true;
  {
    const auto row = request_(e.number);
    if (row.next()) {
      e.request = row.bytes(0);
      request_whole = checksum_of(e, Part::request, e.request) == row.integer(1);
    } else {
      missing = "the request";
    }
  }
  if (e.state != JournalState::accepted) {
    const auto row = reply_(e.number);
    if (row.next()) {
      e.reply = row.bytes(0);
      reply_whole = checksum_of(e, Part::reply, e.reply) == row.integer(1);
    } else {
      missing = "the reply";
    }
  }
  if (missing) {
    const auto row = at_(e.number);
    if (!row.next()) return false;
    refuse_damaged(e, missing);
  }
  if (!request_whole) refuse_damaged(e, "the request");
  if (!reply_whole) refuse_damaged(e, "the reply");
  return true;
}

std::vector<JournalTable::Read> JournalTable::after(int64_t number, int most) {
  std::vector<Read> result;
  const auto row = after_(number, most);
  while (row.next()) {
    result.push_back(read_entry(row));
    // In a damaged file a walk along the numbers might go round for ever.
    const int64_t next = result.back().entry.number;
    if (next <= number)
      throw StorageError(StorageError::Kind::damaged, "is damaged: entries are out of order");
    number = next;
  }
  return result;
}

std::vector<JournalTable::Candidate> JournalTable::oldest(JournalState state,
                                                          int64_t answered_before_us, int most) {
  std::vector<Candidate> result;
  const auto row = oldest_(int64_t(state), answered_before_us, most);
  while (row.next()) result.push_back({row.integer(0), row.integer(1)});
  return result;
}

int64_t JournalTable::count(JournalState state) {
  const auto row = count_(int64_t(state));
  return row.next() ? row.integer(0) : 0;
}

int64_t JournalTable::unanswered_bytes() {
  const auto row = unanswered_bytes_();
  return row.next() ? row.integer(0) : 0;
}

}  // namespace genio

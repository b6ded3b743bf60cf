#include "server/dispatch/dispatcher.hpp"

#include <algorithm>
#include <utility>

namespace genio {

Dispatcher::Dispatcher(const DispatchLimits& limits, std::vector<ModelIdentity> models,
                       JournalLookup journal)
    : limits_(limits),
      models_(std::move(models)),
      journal_(std::move(journal)),
      outbox_(bool(journal_)),
      states_(limits.streams, limits.streams_bytes),
      remembered_(limits.remembered, limits.remembered_bytes) {}

void Dispatcher::refuse(const std::string& client, const std::string& id, const std::string& reason,
                        double retry_after_s) {
  ++tally_.refused, ++tally_.replied;
  command_reply_t reply = reply_without_answer(id, "refused", reason, retry_after_s);
  outbox_.reply(client, encode(reply), Passage::at_once);
  outbox_.note(client, std::move(reply));
}

void Dispatcher::drop_unreadable(const char* channel, size_t size, const std::string& reason) {
  ++tally_.unreadable;
  outbox_.note_drop(channel, size, reason);
}

void Dispatcher::wait_in_line(Entry& entry) {
  entry.state = State::waiting;
  line_.add({entry.request.id, entry.request.priority, stream_of(entry, models_[entry.model]),
             entry.bytes, entry.number});
}

void Dispatcher::forget(const std::string& id) {
  const auto it = entries_.find(id);
  if (it == entries_.end()) return;
  deadlines_.erase({it->second.deadline, id});
  entries_.erase(it);
}

void Dispatcher::drop(const std::string& id, const std::string& reason) {
  const auto it = entries_.find(id);
  if (it == entries_.end() || it->second.state == State::answered) return;
  for (const auto& client : it->second.clients) refuse(client, id, reason, 1);
  line_.remove(id);
  give_up(id);
  forget(id);
}

void Dispatcher::answer(Entry& entry, command_reply_t reply, int64_t now) {
  stamp(entry, models_[entry.model], now, reply);
  entry.reply = encode(reply);
  // Of who asked in an earlier process one is known; the others ask again.
  for (const auto& client : entry.clients) outbox_.reply(client, entry.reply);
  tally_.replied += int64_t(entry.clients.size());
  tally_.past_deadline += reply.status == "deadline";
  tally_.cancelled += reply.status == "cancelled";
  if (!entry.resumed) tally_.add_latency(1e-6 * double(now - entry.accepted));
  outbox_.keep(AnsweredRecord{reply.id, reply.status, entry.reply});
  deadlines_.erase({entry.deadline, reply.id});
  // Repeated questions need the digest and the reply alone.
  entry.request = {}, entry.request.id = reply.id, entry.best.reset();
  entry.bytes = entry.reply.size(), entry.state = State::answered;
  for (const std::string& old : remembered_.add(reply.id, entry.bytes)) forget(old);
  outbox_.note(entry.clients.front(), std::move(reply));
}

void Dispatcher::tell(server_status_t& s) const {
  for (const ModelIdentity& m : models_) s.model.push_back(m.name), s.model_hash.push_back(m.hash);
  s.model_count = int(s.model.size());
  s.queued = int(line_.size()), s.running = int(running_.size());
  tally_.tell(s);
}

void Dispatcher::close() {
  closed_ = true;
  if (journal_) return;
  for (const auto& [id, run] : running_) give_up(id);
}

size_t Dispatcher::refuse_rest() {
  size_t refused = 0;
  if (journal_) return refused;
  std::vector<std::string> rest;
  for (const auto& [id, entry] : entries_)
    if (entry.state != State::answered) rest.push_back(id);
  for (const std::string& id : rest) drop(id, "the server stopped; ask again"), ++refused;
  return refused;
}

}  // namespace genio

#include "server/dispatch/dispatcher.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "server/dispatch/admission.hpp"

namespace genio {
namespace {

constexpr int64_t before_deadline = 2000;  // that a reply is made up [us]
constexpr int most_tries = 2;
constexpr size_t few_waiting = 4;   // requests of a client
constexpr double seconds_held = 5;  // after which to ask again; as long as a program may write
constexpr const char* id_is_taken = "the id was used for another request; choose an id that is new";
constexpr double newest_counts = 0.2;  // of the usual time of a request

}  // namespace

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

double Dispatcher::seconds_until_free() const {
  const double rounds = double(line_.size() + running_.size()) / double(at_once_);
  return std::max(1.0, std::ceil(usual_seconds_ * rounds));
}

std::optional<size_t> Dispatcher::model_named(const std::string& name) const {
  for (size_t k = 0; k < models_.size(); ++k)
    if (name.empty() || models_[k].name == name) return k;
  return std::nullopt;
}

void Dispatcher::receive_request(const void* data, size_t size, int64_t now) {
  std::string why;
  auto request = decode_checked<shape_request_t>(data, size, why);
  ++tally_.received;
  if (!request) {
    ++tally_.unreadable;
    const auto sender = sender_of(data, size);
    const std::string client = sender ? sender->client : unknown_client;
    const std::string id = sender ? sender->id : "";
    for (auto& old : replies_of_earlier_versions(data, size, id))
      outbox_.reply(client, old, Passage::at_once);
    return refuse(client, id, "request cannot be read: " + why);
  }
  std::string fault = fault_of(*request);
  if (fault.empty() && !model_named(request->model)) {
    std::vector<std::string> names;
    for (const ModelIdentity& m : models_) names.push_back(m.name);
    fault = fmt::format("model: '{}' is asked for; this server has {}", request->model,
                        fmt::join(names, ", "));
  }
  if (!fault.empty())
    return refuse(usable_client(request->client) ? request->client : unknown_client,
                  request->id.substr(0, longest_id), fault);
  const auto* bytes = static_cast<const uint8_t*>(data);
  accept(std::move(*request), {bytes, bytes + size}, now);
}

void Dispatcher::ask_again(const shape_request_t& request, const std::string& digest,
                           Entry& entry) {
  const std::string& client = request.client;
  if (digest != entry.digest) return refuse(client, request.id, id_is_taken);
  if (entry.state == State::answered) {
    ++tally_.replied;
    return outbox_.reply(client, entry.reply, Passage::if_room);
  }
  if (entry.asked_by(client)) return;
  if (entry.clients.size() >= limits_.clients)
    return refuse(client, request.id,
                  fmt::format("{} clients wait for that request already; ask again later",
                              entry.clients.size()),
                  seconds_until_free());
  entry.clients.push_back(client);
}

bool Dispatcher::answered_before(const shape_request_t& request, const std::string& digest) {
  const auto known = journal_ ? journal_.find(request.id) : std::nullopt;
  if (!known) return false;
  if (known->digest != digest) return refuse(request.client, request.id, id_is_taken), true;
  // What another process accepted meanwhile, or before, and nobody answered.
  if (known->reply.empty()) return false;
  std::string why;
  if (!decode_checked<command_reply_t>(known->reply.data(), known->reply.size(), why))
    return refuse(request.client, request.id,
                  "it was answered before, and its reply is not of this version; choose a new id"),
           true;
  ++tally_.replied;
  outbox_.reply(request.client, known->reply, Passage::at_once);
  return true;
}

/// The last fifth is for those of whom few wait, so that nobody fills the queue alone.
bool Dispatcher::has_place(const std::string& client, size_t bytes) const {
  const bool few = line_.size_of(client) < few_waiting;
  const auto places = size_t(limits_.waiting), room = limits_.waiting_bytes;
  return line_.size() < places + (few ? places / 4 : 0) &&
         line_.bytes() + bytes <= room + (few ? room / 4 : 0);
}

std::string Dispatcher::why_full(const std::string& client, size_t bytes) const {
  if (closed_) return "the server stops; ask again";
  if (held_)
    return fmt::format("the journal is behind with its writing; ask again in {:.0f} s",
                       seconds_held);
  if (has_place(client, bytes)) return "";
  return fmt::format("the queue is full ({} requests wait); ask again in {:.0f} s", line_.size(),
                     seconds_until_free());
}

void Dispatcher::accept(shape_request_t request, std::vector<uint8_t> bytes, int64_t now) {
  const std::string digest = digest_of(request);
  if (const auto it = entries_.find(request.id); it != entries_.end())
    return ask_again(request, digest, it->second);
  if (answered_before(request, digest)) return;
  if (running_.contains(request.id))
    return refuse(request.client, request.id,
                  "a computation of this id was given up and has not ended yet; ask again", 1);
  if (const std::string why = why_full(request.client, bytes.size()); !why.empty())
    return refuse(request.client, request.id, why, held_ ? seconds_held : seconds_until_free());
  AcceptedRecord record{request.id, request.client, digest,         std::move(bytes), now,
                        0,          request.model,  request.stream, request.priority};
  if (request.deadline_s > 0)
    record.deadline = now + int64_t(std::min(1e6 * request.deadline_s, 1e15));
  enqueue(std::move(request), record);
  outbox_.progress(record.client, progress_of(record.id, "queued", 0, 0), record.id);
  outbox_.keep(std::move(record));
}

Dispatcher::Entry& Dispatcher::enqueue(shape_request_t request, const AcceptedRecord& record) {
  Entry& entry = entries_[record.id] = {};
  entry.request = std::move(request);
  entry.model = model_named(entry.request.model).value_or(0);
  entry.digest = record.digest, entry.clients = {record.client};
  entry.bytes = record.request.size();
  entry.accepted = record.accepted, entry.deadline = record.deadline;
  if (entry.deadline > 0) deadlines_.insert({entry.deadline, record.id});
  wait_in_line(entry);
  return entry;
}

void Dispatcher::wait_in_line(Entry& entry) {
  entry.state = State::waiting;
  line_.add({entry.request.id, entry.request.priority, stream_of(entry, models_[entry.model]),
             entry.bytes, entry.clients.front(), entry.place});
}

void Dispatcher::resume(const AcceptedRecord& record, int tries, int64_t now) {
  std::string why;
  auto request = decode_checked<shape_request_t>(record.request.data(), record.request.size(), why);
  if (request && !model_named(request->model))
    why = fmt::format("no model '{}' is served any more", request->model), request.reset();
  const bool readable = request.has_value();
  if (!readable) request.emplace(), request->id = record.id;
  Entry& entry = enqueue(std::move(*request), record);
  entry.resumed = true, entry.tries = tries;
  if (readable && tries < most_tries) return;
  line_.remove(record.id);
  answer(
      entry,
      reply_without_answer(record.id, "failed",
                           readable ? fmt::format("its computation ended a worker {} times", tries)
                                    : "it cannot be computed by this server: " + why),
      now);
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

void Dispatcher::receive_ack(const void* data, size_t size) {
  std::string why;
  const auto ack = decode_checked<ack_t>(data, size, why);
  if (ack && (ack->id.size() > longest_id || !usable_client(ack->client)))
    why = "the id is too long, or the client's name cannot be used";
  if (!why.empty()) return drop_unreadable("GENIO_ACK", size, why);
  const auto it = entries_.find(ack->id);
  if (it != entries_.end() && !it->second.asked_by(ack->client)) return;
  // Of an earlier process's request the journal knows who asked.
  outbox_.keep(DeliveredRecord{ack->id, it == entries_.end() ? ack->client : ""});
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

void Dispatcher::receive_cancel(const void* data, size_t size, int64_t now) {
  std::string why;
  const auto cancel = decode_checked<cancel_t>(data, size, why);
  if (cancel && !usable_client(cancel->client)) why = "the client's name cannot be used";
  if (!why.empty()) return drop_unreadable("GENIO_CANCEL", size, why);
  const auto it = entries_.find(cancel->id);
  const bool answered = it != entries_.end() && it->second.state == State::answered;
  if (answered && it->second.cancelled && cancel->client == it->second.clients.front()) {
    // It may have missed the reply to its first try.
    ++tally_.replied;
    return outbox_.reply(cancel->client, it->second.reply, Passage::if_room);
  }
  if (it == entries_.end() || answered)
    return refuse(cancel->client, cancel->id.substr(0, longest_id),
                  "no request of that id waits or runs");
  Entry& entry = it->second;
  if (cancel->client != entry.clients.front())
    return refuse(cancel->client, cancel->id, "only the client that asked may withdraw a request");
  give_up(cancel->id);
  entry.cancelled = true;
  if (!line_.remove(cancel->id)) return;
  answer(entry,
         reply_without_answer(cancel->id, "cancelled",
                              "cancelled by the requester before its turn came"),
         now);
}

int64_t Dispatcher::next_deadline() const {
  return deadlines_.empty() ? 0 : deadlines_.begin()->first - before_deadline;
}

void Dispatcher::pass_deadlines(int64_t now) {
  while (!deadlines_.empty() && now >= next_deadline()) {
    const std::string id = deadlines_.begin()->second;
    Entry& entry = entries_.at(id);
    give_up(id);
    const bool waited = line_.remove(id);
    answer(entry, at_deadline(id, entry.best, waited), now);
  }
}

std::optional<Assignment> Dispatcher::next(int64_t now) {
  if (closed_) return std::nullopt;
  const auto chosen = line_.next(busy_);
  if (!chosen) return std::nullopt;
  Entry& entry = entries_.at(chosen->id);
  entry.state = State::running, entry.started = now, entry.place = chosen->place;
  running_[chosen->id] = {chosen->stream};
  if (!chosen->stream.empty()) busy_.insert(chosen->stream);
  at_once_ = std::max(at_once_, running_.size());
  Assignment a{chosen->id, entry.model, encode(entry.request), 0, states_.find(chosen->stream)};
  a.deadline_s = limits_.longest_s;
  if (entry.deadline > 0)
    a.deadline_s = std::clamp(1e-6 * double(entry.deadline - now), 1e-6, limits_.longest_s);
  return a;
}

/// A computation of which nobody waits any more, if it runs.
void Dispatcher::give_up(const std::string& id) {
  const auto run = running_.find(id);
  if (run != running_.end() && !std::exchange(run->second.unwanted, true)) unwanted_.push_back(id);
}

/// What ran under that id, and does not any more.
std::optional<Dispatcher::Running> Dispatcher::end_of(const std::string& id) {
  auto run = running_.extract(id);
  if (run.empty()) return std::nullopt;
  busy_.erase(run.mapped().stream);
  std::erase(unwanted_, id);
  return std::move(run.mapped());
}

std::vector<std::string> Dispatcher::take_unwanted() { return std::exchange(unwanted_, {}); }

void Dispatcher::report_progress(const std::string& id, int iteration, double rms_mm) {
  const auto it = entries_.find(id);
  if (it == entries_.end() || it->second.state != State::running) return;
  for (const auto& client : it->second.clients)
    outbox_.progress(client, progress_of(id, "running", iteration, 1e-3 * rms_mm));
}

void Dispatcher::keep_best(const std::string& id, command_reply_t reply) {
  const auto it = entries_.find(id);
  if (it == entries_.end() || it->second.state != State::running) return;
  auto& best = it->second.best;
  if (!best || says_more(reply, *best)) best = std::move(reply);
}

void Dispatcher::finish(const std::string& id, command_reply_t reply, std::vector<uint8_t> state,
                        int64_t now) {
  const auto run = end_of(id);
  if (!run) return;
  if (!run->stream.empty() && !state.empty()) states_.keep(run->stream, std::move(state));
  ++tally_.computed, tally_.failed += reply.status == "failed";
  const auto it = entries_.find(id);
  if (it == entries_.end() || it->second.state != State::running) return;
  Entry& entry = it->second;
  usual_seconds_ += newest_counts * (1e-6 * double(now - entry.started) - usual_seconds_);
  // What is cut short by a stop in good order is taken up again from the journal, or asked again.
  if (closed_ && reply.status == "cancelled" && !entry.cancelled) {
    if (!journal_) drop(id, "the server stopped; ask again");
    return;
  }
  answer(entry, std::move(reply), now);
}

void Dispatcher::lost(const std::string& id, const std::string& reason, int64_t now) {
  if (!end_of(id)) return;
  const auto it = entries_.find(id);
  if (it == entries_.end() || it->second.state != State::running) return;
  Entry& entry = it->second;
  ++entry.tries;
  outbox_.keep(LostRecord{id});
  if (entry.cancelled)
    return answer(entry, reply_without_answer(id, "cancelled", "cancelled by the requester"), now);
  if (entry.tries < most_tries) return wait_in_line(entry);
  ++tally_.computed, ++tally_.failed;
  answer(entry,
         reply_without_answer(id, "failed",
                              fmt::format("its computation ended a worker {} times, lastly as {}",
                                          entry.tries, reason)),
         now);
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

// How a dispatcher takes messages, and what an earlier process left.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "server/dispatch/admission.hpp"
#include "server/dispatch/dispatcher.hpp"

namespace genio {
namespace {

constexpr const char* id_is_taken = "the id was used for another request; choose an id that is new";
constexpr double seconds_held = 5;  // after which to ask again; as long as a program may write

}  // namespace

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

std::string Dispatcher::why_full(size_t bytes) const {
  if (closed_) return "the server stops; ask again";
  if (held_)
    return fmt::format("the journal is behind with its writing; ask again in {:.0f} s",
                       seconds_held);
  if (int(line_.size()) < limits_.waiting && line_.bytes() + bytes <= limits_.waiting_bytes)
    return "";
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
  if (const std::string why = why_full(bytes.size()); !why.empty())
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

void Dispatcher::receive_ack(const void* data, size_t size) {
  std::string why;
  const auto ack = decode_checked<ack_t>(data, size, why);
  if (!ack) return drop_unreadable("GENIO_ACK", size, why);
  const auto it = entries_.find(ack->id);
  if (it != entries_.end() && !it->second.asked_by(ack->client)) return;
  outbox_.keep(DeliveredRecord{ack->id});
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

}  // namespace genio

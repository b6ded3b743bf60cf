#include "server/dispatch/dispatcher.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "server/dispatch/admission.hpp"

namespace genio {
namespace {

constexpr int64_t before_deadline = 2000;  // that a reply is made up [us]
constexpr int most_tries = 2;
constexpr const char* id_is_taken = "the id was used for another request; choose an id that is new";
constexpr double newest_counts = 0.2;  // of the usual time of a request

}  // namespace

Dispatcher::Dispatcher(const DispatchLimits& limits, std::function<void()> wake,
                       JournalLookup journal)
    : limits_(limits), wake_(std::move(wake)), journal_(std::move(journal)) {}

void Dispatcher::send(OutgoingMessage message) {
  outgoing_.messages.push_back(std::move(message));
  if (wake_) wake_();
}

void Dispatcher::keep(Record record) {
  if (!journal_) return;
  outgoing_.records.push_back(std::move(record));
  if (wake_) wake_();
}

void Dispatcher::reply_to(const std::string& client, command_reply_t reply) {
  // A repeated reply is the same to the byte, so that parts of it which came before still count.
  if (reply.utime == 0) reply.utime = now_us();
  send({"GENIO_REPLY." + client, encode(reply)});
  ++replied_;
}

void Dispatcher::refuse(const std::string& client, const std::string& id, const std::string& reason,
                        double retry_after_s) {
  ++refused_;
  reply_to(client, reply_without_answer(id, "refused", reason, retry_after_s));
}

double Dispatcher::seconds_until_free() const {
  return std::max(1.0, std::ceil(usual_seconds_ * double(waiting_.size() + !running_.empty())));
}

void Dispatcher::receive_request(const void* data, size_t size, int64_t now) {
  std::string why;
  auto request = decode_checked<shape_request_t>(data, size, why);
  const std::lock_guard lock(mutex_);
  ++received_;
  if (!request) {
    const auto sender = sender_of(data, size);
    const std::string client = sender ? sender->client : unknown_client;
    const std::string id = sender ? sender->id : "";
    for (auto& old : replies_of_earlier_versions(data, size, id))
      send({"GENIO_REPLY." + client, std::move(old)});
    return refuse(client, id, "request cannot be read: " + why);
  }
  if (const std::string fault = fault_of(*request); !fault.empty())
    return refuse(usable_client(request->client) ? request->client : unknown_client,
                  request->id.substr(0, 200), fault);
  const auto* bytes = static_cast<const uint8_t*>(data);
  accept(std::move(*request), {bytes, bytes + size}, now);
}

void Dispatcher::ask_again(const shape_request_t& request, Entry& entry) {
  const std::string& client = request.client;
  if (digest_of(request) != entry.digest) return refuse(client, request.id, id_is_taken);
  if (entry.state == State::answered) return reply_to(client, *entry.best);
  if (std::find(entry.clients.begin(), entry.clients.end(), client) == entry.clients.end())
    entry.clients.push_back(client);
}

void Dispatcher::accept(shape_request_t request, std::vector<uint8_t> bytes, int64_t now) {
  if (const auto it = entries_.find(request.id); it != entries_.end())
    return ask_again(request, it->second);
  if (const auto known = journal_ ? journal_.find(request.id) : std::nullopt) {
    std::string why;
    const auto reply =
        decode_checked<command_reply_t>(known->reply.data(), known->reply.size(), why);
    if (known->digest != digest_of(request)) return refuse(request.client, request.id, id_is_taken);
    if (reply) return reply_to(request.client, *reply);
    return refuse(request.client, request.id,
                  "it was answered before, and its reply is not of this version; choose a new id");
  }
  if (closed_)
    return refuse(request.client, request.id, "the server stops; ask again", seconds_until_free());
  if (int(waiting_.size()) >= limits_.waiting ||
      waiting_bytes_ + bytes.size() > limits_.waiting_bytes)
    return refuse(request.client, request.id,
                  fmt::format("the queue is full ({} requests wait); ask again in {:.0f} s",
                              waiting_.size(), seconds_until_free()),
                  seconds_until_free());
  AcceptedRecord record{request.id, request.client, digest_of(request), std::move(bytes), now, 0};
  if (request.deadline_s > 0)
    record.deadline = now + int64_t(std::min(1e6 * request.deadline_s, 1e15));
  enqueue(std::move(request), record);
  send({"GENIO_PROGRESS." + record.client, encode(progress_of(record.id, "queued", 0, 0)),
        record.id});
  keep(std::move(record));
}

void Dispatcher::enqueue(shape_request_t request, const AcceptedRecord& record) {
  Entry entry;
  entry.request = std::move(request);
  entry.digest = record.digest, entry.clients = {record.client};
  entry.bytes = record.request.size(), entry.deadline = record.deadline;
  entries_[record.id] = std::move(entry);
  waiting_.push_back(record.id), waiting_bytes_ += record.request.size();
  changed_.notify_one();
}

void Dispatcher::resume(const AcceptedRecord& record, int tries) {
  std::string why;
  auto request = decode_checked<shape_request_t>(record.request.data(), record.request.size(), why);
  const std::lock_guard lock(mutex_);
  const bool readable = request.has_value();
  if (!readable) request.emplace(), request->id = record.id;
  enqueue(std::move(*request), record);
  if (readable && tries < most_tries) return;
  take_from_queue(record.id);
  answer(entries_.at(record.id),
         reply_without_answer(record.id, "failed",
                              readable
                                  ? fmt::format("its computation ended the server {} times", tries)
                                  : "it is not of this version: " + why));
}

void Dispatcher::drop(const std::string& id, const std::string& reason) {
  const std::lock_guard lock(mutex_);
  const auto it = entries_.find(id);
  if (it == entries_.end()) return;
  for (const auto& client : it->second.clients) refuse(client, id, reason, 1);
  if (it->second.state == State::waiting) take_from_queue(id);
  if (it->second.state != State::answered) entries_.erase(id);
}

void Dispatcher::receive_ack(const void* data, size_t size) {
  std::string why;
  const auto ack = decode_checked<ack_t>(data, size, why);
  const std::lock_guard lock(mutex_);
  if (ack) keep(DeliveredRecord{ack->id});
}

void Dispatcher::take_from_queue(const std::string& id) {
  waiting_.erase(std::find(waiting_.begin(), waiting_.end(), id));
  waiting_bytes_ -= entries_.at(id).bytes;
}

void Dispatcher::answer(Entry& entry, command_reply_t reply) {
  reply.utime = now_us();
  // Of who asked in an earlier process one is known; the others ask again.
  for (const auto& client : entry.clients) reply_to(client, reply);
  if (journal_) keep(AnsweredRecord{entry.request.id, reply.status, encode(reply)});
  // Repeated questions need the digest and the reply alone.
  const std::string id = entry.request.id;
  entry.request = {}, entry.request.id = id;
  entry.bytes = size_t(reply.getEncodedSize());
  entry.best = std::move(reply), entry.state = State::answered;
  answered_.push_back(id), answered_bytes_ += entry.bytes;
  forget_oldest();
}

void Dispatcher::forget_oldest() {
  while (int(answered_.size()) > limits_.remembered ||
         (answered_.size() > 1 && answered_bytes_ > limits_.remembered_bytes)) {
    // What was answered at its deadline may still be computed.
    const auto it = entries_.find(answered_.front());
    answered_bytes_ -= it->second.bytes;
    entries_.erase(it), answered_.pop_front();
  }
}

void Dispatcher::receive_cancel(const void* data, size_t size) {
  std::string why;
  const auto cancel = decode_checked<cancel_t>(data, size, why);
  const std::lock_guard lock(mutex_);
  if (!cancel || !usable_client(cancel->client)) return;
  const auto it = entries_.find(cancel->id);
  const bool answered = it != entries_.end() && it->second.state == State::answered;
  // It may have missed the reply to its first try.
  if (answered && it->second.best->status == "cancelled" &&
      cancel->client == it->second.clients.front())
    return reply_to(cancel->client, *it->second.best);
  if (it == entries_.end() || answered)
    return refuse(cancel->client, cancel->id.substr(0, 200), "no request of that id waits or runs");
  Entry& entry = it->second;
  if (cancel->client != entry.clients.front())
    return refuse(cancel->client, cancel->id, "only the client that asked may withdraw a request");
  entry.cancelled = true;
  if (entry.state != State::waiting) return;
  take_from_queue(cancel->id);
  answer(entry, reply_without_answer(cancel->id, "cancelled",
                                     "cancelled by the requester before its turn came"));
}

void Dispatcher::pass_deadlines(int64_t now) {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> passed;
  const auto look = [&](const std::string& id) {
    const auto it = entries_.find(id);
    if (it != entries_.end() && it->second.state != State::answered && it->second.deadline > 0 &&
        now >= it->second.deadline - before_deadline)
      passed.push_back(id);
  };
  for (const std::string& id : waiting_) look(id);
  if (!running_.empty()) look(running_);
  for (const std::string& id : passed) {
    Entry& entry = entries_.at(id);
    const bool waited = entry.state == State::waiting;
    if (waited) take_from_queue(id);
    answer(entry, at_deadline(id, entry.best, waited));
  }
}

Outgoing Dispatcher::take_outgoing() {
  const std::lock_guard lock(mutex_);
  return std::exchange(outgoing_, Outgoing{});
}

server_status_t Dispatcher::counts() const {
  const std::lock_guard lock(mutex_);
  server_status_t s{};
  s.queued = int(waiting_.size()), s.running = !running_.empty();
  s.received = received_, s.replied = replied_, s.refused = refused_;
  return s;
}

void Dispatcher::close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

void Dispatcher::refuse_waiting() {
  const std::lock_guard lock(mutex_);
  if (journal_) return;
  for (const std::string& id : waiting_)
    for (const auto& client : entries_.at(id).clients)
      refuse(client, id, "the server stopped; ask again", 1);
  for (const std::string& id : waiting_) entries_.erase(id);
  waiting_.clear(), waiting_bytes_ = 0;
}

std::optional<Assignment> Dispatcher::next() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return closed_ || !waiting_.empty(); });
  if (closed_) return std::nullopt;
  const std::string id = waiting_.front();
  take_from_queue(id);
  Entry& entry = entries_.at(id);
  entry.state = State::running, running_ = id;
  keep(TriedRecord{id});
  Assignment a{entry.request, 0};
  if (entry.deadline > 0) a.deadline_s = std::max(1e-6, 1e-6 * double(entry.deadline - now_us()));
  return a;
}

bool Dispatcher::withdrawn(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  const auto it = entries_.find(id);
  return closed_ || it == entries_.end() || it->second.cancelled ||
         it->second.state == State::answered;
}

void Dispatcher::report_progress(const std::string& id, int iteration, double rms) {
  const auto bytes = encode(progress_of(id, "running", iteration, rms));
  const std::lock_guard lock(mutex_);
  if (const auto it = entries_.find(id); it != entries_.end() && it->second.state == State::running)
    for (const auto& client : it->second.clients) send({"GENIO_PROGRESS." + client, bytes});
}

void Dispatcher::keep_best(const std::string& id, command_reply_t reply) {
  const std::lock_guard lock(mutex_);
  const auto it = entries_.find(id);
  if (it == entries_.end() || it->second.state != State::running) return;
  auto& best = it->second.best;
  if (!best || says_more(reply, *best)) best = std::move(reply);
}

void Dispatcher::finish(const std::string& id, const command_reply_t& reply, double seconds) {
  const std::lock_guard lock(mutex_);
  running_.clear();
  usual_seconds_ += newest_counts * (seconds - usual_seconds_);
  const auto it = entries_.find(id);
  if (it == entries_.end() || it->second.state != State::running) return;
  // What is cut short by a stop in good order is taken up again from the journal.
  if (closed_ && journal_ && reply.status == "cancelled" && !it->second.cancelled)
    keep(UntriedRecord{id});
  else answer(it->second, reply);
}

}  // namespace genio

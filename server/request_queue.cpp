#include "server/request_queue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace genio {
namespace {

constexpr const char* unknown_client = "undecodable";

bool usable_name(const std::string& s) {
  return !s.empty() && s.size() <= 40 && std::all_of(s.begin(), s.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-';
  });
}

progress_t progress_of(const std::string& id, const char* stage, int iteration, double rms) {
  progress_t p{};
  p.utime = now_us(), p.id = id, p.stage = stage;
  p.iteration = iteration, p.rms_mm = 1e3 * rms;
  return p;
}

}  // namespace

RequestQueue::RequestQueue(const QueueLimits& limits, std::function<void()> wake)
    : limits_(limits), wake_(std::move(wake)) {}

void RequestQueue::send(const std::string& channel, std::vector<uint8_t> bytes) {
  outgoing_.push_back({channel, std::move(bytes)});
  if (wake_) wake_();
}

void RequestQueue::reply_to(const std::string& client, command_reply_t reply) {
  reply.utime = now_us();
  send("GENIO_REPLY." + client, encode(reply));
  ++replied_;
}

void RequestQueue::refuse(const std::string& client, const std::string& id,
                          const std::string& reason) {
  command_reply_t reply{};
  reply.id = id, reply.status = "failed", reply.verdict = "none", reply.message = reason;
  reply_to(client, std::move(reply));
}

void RequestQueue::receive_request(const void* data, size_t size) {
  std::string why;
  const auto request = decode_checked<shape_request_t>(data, size, why);
  const std::lock_guard lock(mutex_);
  ++received_;
  if (request) return accept(*request);
  ++refused_;
  refuse(unknown_client, "", "request cannot be read: " + why);
}

void RequestQueue::accept(const shape_request_t& request) {
  const bool named = usable_name(request.client);
  const std::string client = named ? request.client : unknown_client;
  const auto refuse_it = [&](const std::string& reason) {
    ++refused_;
    refuse(client, request.id, reason);
  };
  if (!named) return refuse_it("client: expected 1 to 40 letters, digits, '_' or '-'");
  if (request.id.empty() || request.id.size() > 200)
    return refuse_it("id: expected 1 to 200 characters");
  if (const auto it = replies_.find(request.id); it != replies_.end())
    return reply_to(client, it->second);
  if (const auto it = clients_.find(request.id); it != clients_.end()) {
    auto& asking = it->second;
    if (std::find(asking.begin(), asking.end(), client) == asking.end()) asking.push_back(client);
    return;
  }
  if (int(waiting_.size()) >= limits_.waiting)
    return refuse_it(
        fmt::format("the queue is full ({} requests wait); try again later", waiting_.size()));
  clients_[request.id] = {client};
  waiting_.push_back(request);
  send("GENIO_PROGRESS." + client, encode(progress_of(request.id, "queued", 0, 0)));
  changed_.notify_one();
}

void RequestQueue::receive_cancel(const void* data, size_t size) {
  std::string why;
  const auto cancel = decode_checked<cancel_t>(data, size, why);
  if (!cancel) return;
  const std::lock_guard lock(mutex_);
  if (clients_.contains(cancel->id)) cancelled_.insert(cancel->id);
}

std::vector<OutgoingMessage> RequestQueue::take_outgoing() {
  const std::lock_guard lock(mutex_);
  return std::exchange(outgoing_, {});
}

server_status_t RequestQueue::counts() const {
  const std::lock_guard lock(mutex_);
  server_status_t s{};
  s.queued = int(waiting_.size()), s.running = running_;
  s.received = received_, s.replied = replied_, s.refused = refused_;
  return s;
}

void RequestQueue::close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

void RequestQueue::refuse_waiting() {
  const std::lock_guard lock(mutex_);
  for (const auto& request : waiting_)
    for (const auto& client : clients_[request.id])
      refuse(client, request.id, "the server stopped; ask again");
  waiting_.clear();
}

std::optional<shape_request_t> RequestQueue::next() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return closed_ || !waiting_.empty(); });
  if (closed_) return std::nullopt;
  shape_request_t request = std::move(waiting_.front());
  waiting_.pop_front();
  running_ = true;
  return request;
}

bool RequestQueue::withdrawn(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  return closed_ || cancelled_.contains(id);
}

void RequestQueue::report_progress(const std::string& id, int iteration, double rms) {
  const auto bytes = encode(progress_of(id, "running", iteration, rms));
  const std::lock_guard lock(mutex_);
  if (const auto it = clients_.find(id); it != clients_.end())
    for (const auto& client : it->second) send("GENIO_PROGRESS." + client, bytes);
}

void RequestQueue::finish(const std::string& id, const command_reply_t& reply) {
  const std::lock_guard lock(mutex_);
  if (const auto it = clients_.find(id); it != clients_.end()) {
    for (const auto& client : it->second) reply_to(client, reply);
    clients_.erase(it);
  }
  cancelled_.erase(id);
  running_ = false;
  replies_[id] = reply;
  reply_order_.push_back(id);
  if (int(reply_order_.size()) > limits_.remembered) {
    replies_.erase(reply_order_.front());
    reply_order_.pop_front();
  }
}

}  // namespace genio

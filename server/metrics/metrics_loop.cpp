#include "server/metrics/metrics_loop.hpp"

#include <sys/eventfd.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <thread>
#include <utility>

#include "server/metrics/http_request.hpp"

namespace genio {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds no_descriptor_pause{100};
constexpr size_t most_after_all = 64 << 10;  // bytes that are read and thrown away

Descriptor endpoint_wake() {
  Descriptor wake(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK));
  if (!wake) throw std::runtime_error(std::string("cannot serve metrics: ") + std::strerror(errno));
  return wake;
}

/// A child of the process may hold copies of its descriptors, so closing alone is not enough.
void end_for_all(int socket) { shutdown(socket, SHUT_RDWR); }

}  // namespace

MetricsLoop::MetricsLoop(uint16_t port, const MetricsLimits& limits)
    : limits_(limits), listener_(port), wake_(endpoint_wake()) {}

MetricsLoop::~MetricsLoop() {
  delete news_.load();
  end_for_all(listener_.descriptor());
}

void MetricsLoop::publish(std::string text) {
  delete news_.exchange(new std::string(std::move(text)));
}

void MetricsLoop::look_for_news() {
  if (const std::string* news = news_.exchange(nullptr)) text_.reset(news);
}

void MetricsLoop::stop() noexcept {
  stopping_ = true;
  const uint64_t one = 1;
  [[maybe_unused]] const auto written = write(wake_.get(), &one, sizeof one);
}

void MetricsLoop::run() noexcept {
  while (!stopping_) {
    try {
      turn();
    } catch (...) {  // memory is short
      connections_.clear();
      std::this_thread::sleep_for(no_descriptor_pause);
    }
  }
  for (Connection& c : connections_) end_for_all(c.socket.get());
  connections_.clear();
}

void MetricsLoop::turn() {
  const Time before = Clock::now();
  std::vector<pollfd> polled = watched(before);
  if (poll(polled.data(), polled.size(), patience_ms(before)) < 0) return;
  const Time now = Clock::now();
  for (size_t k = 2; k < polled.size(); ++k)
    if (polled[k].revents) serve(connections_[k - 2]);
  if (polled[1].revents) accept_some(now);
  for (Connection& c : connections_)
    if (now >= due(c)) c.ended = true;
  for (const Connection& c : connections_)
    if (c.ended) end_for_all(c.socket.get());
  std::erase_if(connections_, [](const Connection& c) { return c.ended; });
}

/// The wake-up, the listener, then the connections.
std::vector<pollfd> MetricsLoop::watched(Time now) const {
  std::vector<pollfd> all;
  all.reserve(connections_.size() + 2);
  all.push_back({wake_.get(), POLLIN, 0});
  all.push_back({now >= accept_again_ ? listener_.descriptor() : -1, POLLIN, 0});
  for (const Connection& c : connections_)
    all.push_back({c.socket.get(), short(c.response.empty() ? POLLIN : POLLOUT), 0});
  return all;
}

/// How long nothing needs to be done unless something happens [ms]; -1: for ever.
int MetricsLoop::patience_ms(Time now) const {
  Time next = now < accept_again_ ? accept_again_ : Time::max();
  for (const Connection& c : connections_) next = std::min(next, due(c));
  if (next == Time::max()) return -1;
  return int(std::chrono::ceil<milliseconds>(std::max(next, now) - now).count());
}

MetricsLoop::Time MetricsLoop::due(const Connection& c) const {
  return c.since + (c.judged ? limits_.whole : limits_.request);
}

/// Half of the places at a time, and each is heard at once: whoever sends a request is answered
/// before others can take the place.
void MetricsLoop::accept_some(Time now) {
  for (size_t k = 0; k < std::max<size_t>(limits_.connections / 2, 1); ++k) {
    HubListener::Arrival arrival = accept_one();
    if (arrival.outcome == HubListener::Outcome::nobody) return;
    if (arrival.outcome == HubListener::Outcome::no_descriptor)
      return void(accept_again_ = now + no_descriptor_pause);
    if (arrival.outcome == HubListener::Outcome::turned_away) continue;
    if (connections_.size() >= limits_.connections) {
      end_for_all(connections_.front().socket.get());
      connections_.pop_front();
    }
    connections_.push_back({std::move(arrival.socket), now});
    serve(connections_.back());
  }
}

/// Where the process has no descriptor left, the oldest connection gives its own.
HubListener::Arrival MetricsLoop::accept_one() {
  HubListener::Arrival arrival = listener_.accept();
  if (arrival.outcome != HubListener::Outcome::no_descriptor) return arrival;
  if (connections_.empty()) return listener_.accept_with_reserve();
  end_for_all(connections_.front().socket.get());
  connections_.pop_front();
  return listener_.accept();
}

void MetricsLoop::serve(Connection& c) {
  if (c.response.empty()) hear(c);
  if (!c.response.empty()) say(c);
}

void MetricsLoop::hear(Connection& c) {
  std::array<char, longest_http_request> bytes;
  const ssize_t got = recv(c.socket.get(), bytes.data(), bytes.size(), MSG_DONTWAIT);
  if (got < 0) {
    c.ended = errno != EAGAIN && errno != EINTR;
  } else if (got == 0) {
    c.ended = true;
  } else if (c.judged) {
    c.after_all += size_t(got);
    c.ended = c.after_all > most_after_all;
  } else {
    c.received.append(bytes.data(), size_t(got));
    const HttpVerdict verdict = judge_http(c.received);
    if (verdict.answer == HttpAnswer::not_yet) return;
    look_for_news();
    c.judged = true;
    c.response = http_response(verdict, text_.get());
  }
}

/// Once all is said the other side is waited for: closing with unread bytes would cut off what is
/// still on its way.
void MetricsLoop::say(Connection& c) {
  const ssize_t sent =
      send(c.socket.get(), c.response.data(), c.response.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
  if (sent < 0) c.ended = errno != EAGAIN && errno != EINTR;
  else c.response.erase(0, size_t(sent));
  if (c.response.empty()) shutdown(c.socket.get(), SHUT_WR);
}

}  // namespace genio

#pragma once
// What the thread of a metrics endpoint does.

#include <poll.h>

#include <atomic>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "server/hub/listener.hpp"
#include "server/metrics/metrics_endpoint.hpp"

namespace genio {

/// run() is for its thread; publish() and stop() are for another one.
class MetricsLoop {
 public:
  MetricsLoop(uint16_t port, const MetricsLimits& limits);
  ~MetricsLoop();
  MetricsLoop(const MetricsLoop&) = delete;
  MetricsLoop& operator=(const MetricsLoop&) = delete;

  uint16_t port() const { return listener_.port(); }
  void publish(std::string text);
  void run() noexcept;
  void stop() noexcept;

 private:
  using Clock = std::chrono::steady_clock;
  using Time = Clock::time_point;
  struct Connection {
    Descriptor socket;
    Time since;
    std::string received = {}, response = {};  ///< the response: what is not sent yet
    bool judged = false, ended = false;
    size_t after_all = 0;  ///< bytes that came when all was said
  };

  void turn();
  std::vector<pollfd> watched(Time now) const;
  int patience_ms(Time now) const;
  Time due(const Connection& connection) const;
  void accept_some(Time now);
  HubListener::Arrival accept_one();
  void serve(Connection& connection);
  void hear(Connection& connection);
  void say(Connection& connection);
  void look_for_news();

  const MetricsLimits limits_;
  HubListener listener_;
  Descriptor wake_;
  std::deque<Connection> connections_;  // oldest first
  Time accept_again_{};
  std::unique_ptr<const std::string> text_;
  std::atomic<const std::string*> news_{nullptr};  // owned by whoever takes it out
  std::atomic<bool> stopping_{false};
};

}  // namespace genio

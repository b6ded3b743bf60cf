#pragma once
// What a hub's thread does.

#include <atomic>
#include <mutex>
#include <optional>

#include "server/hub/exchange.hpp"
#include "server/hub/listener.hpp"
#include "server/hub/poller.hpp"
#include "server/hub/table.hpp"
#include "server/hub/take_turns.hpp"

namespace genio {

/// Owns all that a hub is made of. run() is for its thread; finish() and counts() are for others.
class HubLoop {
 public:
  /// Throws InputError when the port is taken, std::runtime_error when the system gives no more.
  HubLoop(uint16_t port, const HubLimits& limits);

  /// Serves until finish() was called and what it asks for is done.
  void run() noexcept;

  /// Nobody new is taken from now on. What clients had sent is relayed, and what waits is sent to
  /// those who read, until `until`; then all connections are closed and run() returns.
  void finish(HubTime until) noexcept;

  /// See Hub::favour.
  void favour(uint16_t port) noexcept;

  uint16_t port() const { return port_; }
  HubCounts counts() const;

 private:
  void turn();
  void wait_for_events();
  int patience_ms(HubTime now) const;
  void note(const epoll_event& event);
  void accept_all(HubTime now);
  bool admit_one(HubTime now);
  HubListener::Arrival accept_one(HubTime now);
  void pause_accepting(HubTime now);
  void settle(HubTime now);
  void remove_ended(HubClock::duration longest);
  void watch(HubConnection& connection, HubTime now);
  void hold_back(HubConnection& connection, HubTime now);
  void forget(HubConnection& connection);
  void begin_to_finish(HubTime now);
  void stop_reading(HubConnection& connection, HubTime now);
  bool is_done(HubTime now) const;
  void close_all();

  HubListener listener_;
  const uint16_t port_;
  Descriptor wake_;
  HubTable table_;
  HubExchange exchange_;
  HubTurns turns_;
  Poller poller_;
  std::optional<HubTime> next_due_, accept_again_, until_, read_until_;
  bool somebody_arrives_ = false;

  std::atomic<uint16_t> favoured_port_{0};
  mutable std::mutex shared_;  // guards the two below
  std::optional<HubTime> asked_to_finish_;
  HubCounts counts_;
};

}  // namespace genio

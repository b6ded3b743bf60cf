#pragma once
// A message hub for LCM's tcpq transport, on this host only.

#include <chrono>
#include <cstdint>
#include <memory>
#include <thread>

#include "server/hub/counts.hpp"
#include "server/hub/limits.hpp"

namespace genio {

class HubLoop;

/// Relays published messages to every connection that subscribed to a matching channel, as LCM's
/// TCPService does. It listens on 127.0.0.1 only, runs in a thread of its own, and holds its
/// clients to limits: who floods it, reads nothing or sends nonsense loses the connection, and
/// nobody else notices. There is no end-to-end flow control in the protocol, so a client that falls
/// behind by more than HubLimits::backlog_bytes is one that reads nothing.
class Hub {
 public:
  /// Listens at once; port 0 chooses a free one. Throws InputError when the port is taken, and
  /// std::runtime_error when the system has no descriptor or thread left.
  explicit Hub(uint16_t port, const HubLimits& limits = {});
  /// Closes all connections at once, unless flush() was called before.
  ~Hub();
  Hub(const Hub&) = delete;
  Hub& operator=(const Hub&) = delete;

  uint16_t port() const { return port_; }
  /// May be called from any thread. The numbers are of one moment, a few milliseconds ago.
  HubCounts counts() const;

  /// Says from which port the service itself is connected; 0: from none, as at first. This
  /// connection has its turns first and is not displaced. While it has much to read, those who
  /// flood the hub wait, so that what they send to the service does not crowd out others. From any
  /// thread.
  void favour(uint16_t port);

  /// Ends the hub: no connection is taken from now on. What clients had sent before is relayed, and
  /// all that waits is sent to those who read. Returns when that is done, or after `longest`, and
  /// all connections are closed then. A client counts as silent after 100 ms; one that sends on is
  /// heard for half a second, and one that takes nothing for a second is not waited for. For the
  /// thread that owns the hub.
  void flush(std::chrono::milliseconds longest);

 private:
  std::unique_ptr<HubLoop> loop_;
  uint16_t port_;
  std::thread thread_;
};

}  // namespace genio

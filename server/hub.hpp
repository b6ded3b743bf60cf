#pragma once
// A message hub for LCM's tcpq transport, on this host only.

#include <atomic>
#include <memory>
#include <string>
#include <thread>

namespace genio {

/// Relays published messages to every connection that subscribed to a matching channel, as LCM's
/// TCPService does, but bound to 127.0.0.1 and with size caps. Runs in a thread of its own.
class Hub {
 public:
  /// Listens at once; port 0 chooses a free one. Throws std::runtime_error when the port is taken.
  explicit Hub(uint16_t port);
  ~Hub();
  Hub(const Hub&) = delete;
  Hub& operator=(const Hub&) = delete;
  uint16_t port() const { return port_; }

 private:
  struct Connection;
  void run();

  int listener_ = -1, wake_ = -1;
  uint16_t port_ = 0;
  std::thread thread_;
};

}  // namespace genio

#pragma once
#include <chrono>
#include <cstddef>

namespace genio {

using UdpmClock = std::chrono::steady_clock;
using UdpmTime = UdpmClock::time_point;

/// What messages over UDP multicast may take. The defaults suit one service and its clients; tests
/// use smaller ones.
struct UdpmLimits {
  size_t datagram_bytes = 1400;                   ///< of what is sent; Ethernet carries 1472
  size_t message_bytes = (4 << 20) + (64 << 10);  ///< as the hub's

  // Sending. A receiver's usual buffer of 208 kB holds some 90 full datagrams, so it may pause for
  // 12 ms at this pace.
  double bytes_per_s = 8e6;       ///< parts alone; short messages go at once, and count
  size_t burst_bytes = 32 << 10;  ///< after a pause
  size_t kept_bytes = 64 << 20;   ///< messages that are being sent, or were, for who misses parts
  size_t kept_messages = 1024;
  std::chrono::milliseconds kept{10000};  ///< since a part of it was last sent
  int sendings = 16;                      ///< of one part, for each time its message is published

  // Receiving.
  size_t unfinished_bytes = 32 << 20;  ///< all together; half of it for one sender
  size_t unfinished_messages = 256;
  size_t parts = 8192;                            ///< of one message
  std::chrono::milliseconds unfinished{10000};    ///< since the last part that was new
  std::chrono::milliseconds first_ask{30};        ///< likewise; then twice as long each time
  std::chrono::milliseconds longest_pause{1000};  ///< between two asks for the same message
  size_t finished_messages = 1024;                ///< that are remembered, to know late parts
  std::chrono::milliseconds finished{10000};
};

}  // namespace genio

#pragma once
#include <chrono>
#include <cstddef>

namespace genio {

/// What the clients of a hub may take. The defaults suit one service and what talks to it; tests
/// use smaller ones.
struct HubLimits {
  size_t connections = 256;                       ///< also half the process's descriptors at most
  size_t name_bytes = 256;                        ///< a channel, or a pattern of channels
  size_t payload_bytes = (4 << 20) + (64 << 10);  ///< Genio's own messages have 4 MiB at most
  size_t subscriptions = 64;                      ///< a connection
  size_t programs = 8;  ///< a connection: patterns that are more than a name with dots
  /// All connections: instructions of the programs. A publication takes up to 2 us for each.
  size_t program_cost = 4096;
  size_t backlog_bytes = 8 << 20;   ///< a connection: what waits until it reads
  size_t backlog_messages = 8192;   ///< likewise; many small ones take time to forget
  size_t queued_bytes = 32 << 20;   ///< all connections; a message that many wait for counts once
  size_t partial_bytes = 32 << 20;  ///< all connections: messages of which a part has come
  size_t read_bytes = 128 << 10;    ///< from one connection before others have their turn
  size_t sent_bytes = 256 << 10;    ///< likewise to one connection

  std::chrono::milliseconds greeting{2000};  ///< from a connection's start to its whole greeting
  std::chrono::milliseconds partial{10000};  ///< without a further byte of a message that began
  std::chrono::milliseconds draining{5000};  ///< without a byte taken of what waits
};

}  // namespace genio

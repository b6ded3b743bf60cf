#pragma once
#include <netinet/in.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "server/hub/descriptor.hpp"
#include "server/udpm/udpm_address.hpp"

namespace genio {

/// Sends datagrams to a multicast group, and receives those that are sent to it. It is bound to the
/// group itself, so that the system drops what is sent to an address of this host.
class MulticastSocket {
 public:
  /// Throws std::system_error that says what the system refused, as for want of a multicast route.
  explicit MulticastSocket(const UdpmAddress& address);

  /// Becomes readable when a datagram is there.
  int descriptor() const { return receiving_.get(); }

  struct Received {
    std::span<const uint8_t> bytes;  ///< until the next call
    sockaddr_in source{};
  };
  /// A datagram that is there; nothing where there is none.
  std::optional<Received> receive();
  /// False where the system does not take it now.
  bool send(std::span<const uint8_t> bytes);
  /// Datagrams that found the buffer full, as far as later ones told.
  uint64_t overflowed() const { return overflowed_; }

 private:
  sockaddr_in group_{};
  Descriptor sending_, receiving_;
  std::vector<uint8_t> buffer_;
  uint32_t overflowed_ = 0;
};

}  // namespace genio

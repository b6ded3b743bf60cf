#pragma once
#include <sys/epoll.h>

#include <cstdint>
#include <span>
#include <vector>

#include "server/hub/descriptor.hpp"

namespace genio {

/// Waits for descriptors, each of which goes by a number.
class Poller {
 public:
  /// At most `most` descriptors are reported at a time. Throws std::runtime_error.
  explicit Poller(size_t most);

  /// Asks for the events of a descriptor from now on. False when the system refuses.
  bool watch(int fd, uint64_t number, uint32_t events, bool known);
  void forget(int fd);
  /// Waits until something happens, or `timeout_ms` (-1: for ever). The result holds until the next
  /// call; `data.u64` is the number.
  std::span<const epoll_event> wait(int timeout_ms);

 private:
  Descriptor epoll_;
  std::vector<epoll_event> events_;
};

}  // namespace genio

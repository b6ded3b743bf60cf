#pragma once
#include <sys/epoll.h>

#include <cstdint>
#include <span>
#include <vector>

#include "server/hub/descriptor.hpp"

namespace genio {

/// Waits for descriptors, each of which goes by a number. Some of them can wait themselves.
class Poller {
 public:
  enum class Order {
    always,    ///< what happens is reported at once
    with_time  ///< only by wait_for_all()
  };

  /// At most `most` descriptors of either order are reported at a time. Throws std::runtime_error.
  explicit Poller(size_t most);

  /// Asks for the events of a descriptor from now on. `known`: it was asked for before, in the same
  /// order. False when the system refuses.
  bool watch(int fd, uint64_t number, uint32_t events, bool known, Order order);
  void forget(int fd, Order order);

  /// Waits until something happens, or `timeout_ms` (-1: for ever). The result holds until the next
  /// call; `data.u64` is the number.
  std::span<const epoll_event> wait_for_all(int timeout_ms);
  /// The same, only of those that are always reported.
  std::span<const epoll_event> wait_for_some(int timeout_ms);

 private:
  Descriptor& set_of(Order order) { return order == Order::always ? always_ : with_time_; }
  bool report_with_time(bool wanted);
  size_t collect(const Descriptor& set, size_t at, int timeout_ms);

  size_t most_;
  Descriptor with_time_, always_;  // the first is one of those that the second watches
  bool with_time_is_reported_ = false;
  std::vector<epoll_event> events_;
};

}  // namespace genio

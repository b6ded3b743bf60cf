#include "server/hub/poller.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>

namespace genio {

Poller::Poller(size_t most) : epoll_(epoll_create1(EPOLL_CLOEXEC)), events_(most) {
  if (!epoll_)
    throw std::runtime_error(std::string("cannot wait for connections: ") + std::strerror(errno));
}

bool Poller::watch(int fd, uint64_t number, uint32_t events, bool known) {
  epoll_event event{};
  event.events = events;
  event.data.u64 = number;
  return epoll_ctl(epoll_.get(), known ? EPOLL_CTL_MOD : EPOLL_CTL_ADD, fd, &event) == 0;
}

void Poller::forget(int fd) { epoll_ctl(epoll_.get(), EPOLL_CTL_DEL, fd, nullptr); }

std::span<const epoll_event> Poller::wait(int timeout_ms) {
  const int count = epoll_wait(epoll_.get(), events_.data(), int(events_.size()), timeout_ms);
  return {events_.data(), size_t(std::max(count, 0))};
}

}  // namespace genio

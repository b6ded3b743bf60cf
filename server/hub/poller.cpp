#include "server/hub/poller.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>

namespace genio {
namespace {

constexpr uint64_t with_time_number = ~uint64_t(0) - 2;  // no descriptor's

[[noreturn]] void refuse_to_poll() {
  throw std::runtime_error(std::string("cannot wait for connections: ") + std::strerror(errno));
}

bool control(const Descriptor& set, int what, int fd, uint64_t number, uint32_t events) {
  epoll_event event{};
  event.events = events;
  event.data.u64 = number;
  return epoll_ctl(set.get(), what, fd, &event) == 0;
}

}  // namespace

Poller::Poller(size_t most)
    : most_(most + 1),
      with_time_(epoll_create1(EPOLL_CLOEXEC)),
      always_(epoll_create1(EPOLL_CLOEXEC)),
      events_(2 * most_) {
  if (!with_time_ || !always_ ||
      !control(always_, EPOLL_CTL_ADD, with_time_.get(), with_time_number, 0))
    refuse_to_poll();
}

bool Poller::watch(int fd, uint64_t number, uint32_t events, bool known, Order order) {
  return control(set_of(order), known ? EPOLL_CTL_MOD : EPOLL_CTL_ADD, fd, number, events);
}

void Poller::forget(int fd, Order order) {
  epoll_ctl(set_of(order).get(), EPOLL_CTL_DEL, fd, nullptr);
}

/// One call stops or starts the reports of a whole order.
bool Poller::report_with_time(bool wanted) {
  if (wanted == with_time_is_reported_) return true;
  const bool done = control(always_, EPOLL_CTL_MOD, with_time_.get(), with_time_number,
                            wanted ? uint32_t(EPOLLIN) : 0u);
  if (done) with_time_is_reported_ = wanted;
  return done;
}

size_t Poller::collect(const Descriptor& set, size_t at, int timeout_ms) {
  const int count = epoll_wait(set.get(), events_.data() + at, int(most_), timeout_ms);
  return at + size_t(std::max(count, 0));
}

std::span<const epoll_event> Poller::wait_for_some(int timeout_ms) {
  report_with_time(false);
  return {events_.data(), collect(always_, 0, timeout_ms)};
}

std::span<const epoll_event> Poller::wait_for_all(int timeout_ms) {
  report_with_time(true);
  size_t count = collect(always_, 0, timeout_ms);
  const auto end = events_.begin() + std::ptrdiff_t(count);
  const auto other = std::find_if(
      events_.begin(), end, [](const epoll_event& e) { return e.data.u64 == with_time_number; });
  if (other == end) return {events_.data(), count};
  *other = events_[--count];
  return {events_.data(), collect(with_time_, count, 0)};
}

}  // namespace genio

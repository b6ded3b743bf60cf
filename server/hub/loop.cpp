#include "server/hub/loop.hpp"

#include <sys/eventfd.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

namespace genio {
namespace {

using std::chrono::milliseconds;

constexpr uint64_t wake_number = ~uint64_t(0), listener_number = wake_number - 1;
constexpr int most_arrivals = 32;                          // in a round
constexpr std::chrono::microseconds longest_arrival{500};  // of them all
constexpr std::chrono::microseconds longest_parting{500};  // with those that were dropped
constexpr milliseconds accept_pause{100};                  // when not even one can be turned away
// Once the hub ends:
constexpr milliseconds last_patience{1000};  // with who reads nothing
constexpr milliseconds last_words{100};      // what is still on its way does not pause as long
constexpr milliseconds last_reading{500};    // from who floods

Descriptor wake_descriptor() {
  Descriptor wake(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK));
  if (!wake) throw std::runtime_error(std::string("cannot start a hub: ") + std::strerror(errno));
  return wake;
}

/// Lets the system deliver what it was given: closing with unread bytes would cut that off.
void close_gently(int socket) {
  shutdown(socket, SHUT_WR);
  std::array<char, 16384> unread;
  for (int k = 0; k < 256; ++k)  // more than a socket holds, and an end for one that floods
    if (recv(socket, unread.data(), unread.size(), MSG_DONTWAIT) <= 0) break;
}

Poller::Order order_of(const HubConnection& c) {
  return c.standing.uses_much ? Poller::Order::with_time : Poller::Order::always;
}

uint32_t wanted_events(const HubConnection& c) {
  const uint32_t out = c.backlog.empty() ? 0u : uint32_t(EPOLLOUT);
  if (!c.reading) return out;
  if (!c.standing.held_back) return EPOLLIN | EPOLLRDHUP | out;
  // That the other side of one who is not read from is gone would be reported without end.
  return out != 0 ? out : uint32_t(EPOLLRDHUP | EPOLLET);
}

void earliest(std::optional<HubTime>& due, const std::optional<HubTime>& other) {
  if (other && (!due || *other < *due)) due = other;
}

}  // namespace

HubLoop::HubLoop(uint16_t port, const HubLimits& limits)
    : listener_(port),
      port_(listener_.port()),
      wake_(wake_descriptor()),
      table_(limits),
      exchange_(table_),
      turns_(table_, exchange_),
      poller_(table_.limits().connections + 3) {
  if (!poller_.watch(wake_.get(), wake_number, EPOLLIN, false, Poller::Order::always) ||
      !poller_.watch(listener_.descriptor(), listener_number, EPOLLIN, false,
                     Poller::Order::with_time))
    throw std::runtime_error(std::string("cannot start a hub: ") + std::strerror(errno));
}

void HubLoop::finish(HubTime until) noexcept {
  {
    const std::lock_guard lock(shared_);
    asked_to_finish_ = until;
  }
  const uint64_t one = 1;
  [[maybe_unused]] const auto written = write(wake_.get(), &one, sizeof one);
}

void HubLoop::favour(uint16_t port) noexcept { favoured_port_ = port; }

HubCounts HubLoop::counts() const {
  const std::lock_guard lock(shared_);
  return counts_;
}

void HubLoop::run() noexcept {
  while (!until_ || !is_done(HubClock::now())) {
    try {
      turn();
    } catch (...) {
      // Memory is short outside of any connection's turn: the heaviest one pays.
      if (!table_.drop_heaviest(HubDrop::out_of_memory)) std::this_thread::sleep_for(accept_pause);
    }
  }
  close_all();
}

void HubLoop::turn() {
  somebody_arrives_ = false;
  wait_for_events();
  const HubTime now = HubClock::now();
  if (accept_again_ && now >= *accept_again_) {
    accept_again_.reset();
    poller_.watch(listener_.descriptor(), listener_number, EPOLLIN, true, Poller::Order::with_time);
  }
  if (somebody_arrives_ && !until_) accept_all(now);
  turns_.give(HubClock::now());
  settle(HubClock::now());
}

void HubLoop::wait_for_events() {
  const HubTime begin = HubClock::now();
  int patience = patience_ms(begin);
  if (turns_.rests()) {
    for (const epoll_event& event : poller_.wait_for_some(patience)) note(event);
    patience = 0;
    turns_.pace().slept(HubClock::now() - begin);
  }
  // When a rest ends all are looked at, before those of whom something is left have their turns.
  if (turns_.rests()) return;
  const HubTime middle = HubClock::now();
  for (const epoll_event& event : poller_.wait_for_all(patience)) note(event);
  turns_.pace().slept(HubClock::now() - middle);
}

/// How long nothing needs to be done unless something happens [ms]; -1: for ever.
int HubLoop::patience_ms(HubTime now) const {
  if (turns_.more_to_understand() || (!turns_.rests() && table_.some_ended())) return 0;
  std::optional<HubTime> due = next_due_;
  if (turns_.pace().rests()) earliest(due, now + turns_.pace().left());
  earliest(due, accept_again_);
  earliest(due, until_);
  if (!due) return -1;
  if (*due <= now) return 0;
  return int(std::chrono::ceil<milliseconds>(*due - now).count());
}

void HubLoop::note(const epoll_event& event) {
  if (event.data.u64 == listener_number) {
    somebody_arrives_ = true;
  } else if (event.data.u64 == wake_number) {
    uint64_t count = 0;
    [[maybe_unused]] const auto size = read(wake_.get(), &count, sizeof count);
    begin_to_finish(HubClock::now());
  } else if (HubConnection* const c = table_.find(event.data.u64)) {
    const bool gone = event.events & (EPOLLHUP | EPOLLERR);
    c->in.ready = gone || event.events & EPOLLIN;
    c->out.ready = event.events & EPOLLOUT;
    c->standing.left |= bool(event.events & EPOLLRDHUP);
    if (gone && !c->reading && c->unread.empty()) table_.end(*c);
  }
}

void HubLoop::accept_all(HubTime now) {
  for (int k = 0; k < most_arrivals && HubClock::now() - now < longest_arrival; ++k)
    if (!admit_one(now)) break;
  turns_.pace().worked(HubClock::now() - now);
}

/// False where nobody else can be taken now.
bool HubLoop::admit_one(HubTime now) {
  if (table_.all().size() > table_.limits().connections) remove_ended(longest_parting);
  HubListener::Arrival arrival = accept_one(now);
  if (arrival.outcome == HubListener::Outcome::nobody) return false;
  if (arrival.outcome == HubListener::Outcome::no_descriptor) return pause_accepting(now), false;
  if (arrival.outcome == HubListener::Outcome::turned_away) return true;
  try {
    HubConnection& c = table_.admit(std::move(arrival.socket), arrival.port, now);
    c.in.ready = c.out.ready = true;  // to be greeted at once
  } catch (const std::bad_alloc&) {
    ++table_.counters().dropped(HubDrop::out_of_memory);
  }
  return true;
}

/// Where the process has no descriptor for a newcomer, a connection makes place for it. Where there
/// is none, or somebody else took what it left, the newcomer may be turned away.
HubListener::Arrival HubLoop::accept_one(HubTime now) {
  HubListener::Arrival arrival = listener_.accept();
  if (arrival.outcome != HubListener::Outcome::no_descriptor) return arrival;
  ++table_.counters().dropped(HubDrop::out_of_descriptors);
  if (table_.drop_least_useful(HubDrop::displaced, now)) {
    remove_ended(HubClock::duration::max());
    arrival = listener_.accept();
    if (arrival.outcome != HubListener::Outcome::no_descriptor) return arrival;
  }
  return listener_.accept_with_reserve();
}

/// Who waits would be reported without end.
void HubLoop::pause_accepting(HubTime now) {
  poller_.watch(listener_.descriptor(), listener_number, 0, true, Poller::Order::with_time);
  accept_again_ = now + accept_pause;
}

void HubLoop::settle(HubTime now) {
  next_due_.reset();
  for (auto& [id, c] : table_.all()) {
    c.in.ready = c.out.ready = false;
    const auto due = hub_due(c.standing, table_.limits());
    if (!c.ended && due && due->at <= now) table_.drop(c, due->why);
    if (!c.ended && until_) stop_reading(c, now);
    if (c.ended) forget(c);
    else watch(c, now);
    if (!c.ended && due) earliest(next_due_, due->at);
  }
  if (!turns_.rests()) remove_ended(longest_parting);
  const std::lock_guard lock(shared_);
  counts_ = table_.counts();
}

void HubLoop::watch(HubConnection& c, HubTime now) {
  const bool favoured = c.port != 0 && c.port == favoured_port_;
  if (favoured && !c.standing.favoured) table_.favour(c);
  c.standing.favoured = favoured;
  hold_back(c, now);
  const bool much = !favoured && c.usage.is_much(now, c.standing.uses_much);
  if (much != c.standing.uses_much) {
    forget(c);
    c.standing.uses_much = much;
  }
  const uint32_t events = wanted_events(c);
  if (c.watched == events) return;
  if (poller_.watch(c.socket.get(), c.id, events, c.watched.has_value(), order_of(c)))
    c.watched = events;
  else table_.drop(c, HubDrop::out_of_memory);
}

/// It is not the fault of who is held back that its message does not go on.
void HubLoop::hold_back(HubConnection& c, HubTime now) {
  c.standing.held_back = !until_ && table_.holds_back(c, now);
  if (!c.standing.held_back) return;
  c.standing.partial_grew = now;
  if (is_newcomer(c.standing, now)) earliest(next_due_, newcomer_until(c.standing));
}

void HubLoop::forget(HubConnection& c) {
  if (c.watched) poller_.forget(c.socket.get(), order_of(c));
  c.watched.reset();
}

/// Removes those that were dropped, for so long and one at least. A child of the process may hold
/// copies of its descriptors, so closing alone is not enough.
void HubLoop::remove_ended(HubClock::duration longest) {
  const HubTime begin = HubClock::now();
  HubClock::duration time{0};
  for (HubConnection* c; time < longest && (c = table_.next_ended());) {
    forget(*c);
    shutdown(c->socket.get(), SHUT_RDWR);
    table_.remove(*c);
    time = HubClock::now() - begin;
  }
  turns_.pace().worked(time);
}

void HubLoop::begin_to_finish(HubTime now) {
  {
    const std::lock_guard lock(shared_);
    if (!asked_to_finish_) return;
    until_ = asked_to_finish_;
  }
  if (listener_.descriptor() < 0) return;  // has begun before
  accept_all(now);
  poller_.forget(listener_.descriptor(), Poller::Order::with_time);
  turns_.pace().end();
  listener_.close();
  accept_again_.reset();
  HubLimits& limits = table_.limits();
  limits.draining = std::min(limits.draining, last_patience);
  read_until_ = now + last_reading;
  for (auto& [id, c] : table_.all()) c.standing.drained = c.heard = now;
}

/// What was sent before the end may still be in the buffers of the system, also in the sender's, so
/// a connection is read until it pauses.
void HubLoop::stop_reading(HubConnection& c, HubTime now) {
  const HubTime stop = std::min(c.heard + last_words, *read_until_);
  if (now >= stop) c.reading = false;
  else earliest(next_due_, stop);
}

bool HubLoop::is_done(HubTime now) const {
  if (now >= *until_) return true;
  const auto& all = table_.all();
  return std::all_of(all.begin(), all.end(), [](const auto& entry) {
    const HubConnection& c = entry.second;
    return c.ended || (!c.reading && c.unread.empty() && c.backlog.empty());
  });
}

void HubLoop::close_all() {
  listener_.close();
  remove_ended(HubClock::duration::max());
  for (auto& [id, c] : table_.all()) {
    close_gently(c.socket.get());
    table_.end(c);
  }
  remove_ended(HubClock::duration::max());
  const std::lock_guard lock(shared_);
  counts_ = table_.counts();
}

}  // namespace genio

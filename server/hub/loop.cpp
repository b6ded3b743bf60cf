#include "server/hub/loop.hpp"

#include <sys/eventfd.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

namespace genio {
namespace {

using std::chrono::milliseconds;

constexpr uint64_t wake_number = ~uint64_t(0), listener_number = wake_number - 1;
constexpr int most_arrivals = 32;         // in a round
constexpr milliseconds longest_round{2};  // of turns, before new events are looked for
// All who wait share this, so that the last of them waits no longer when there are more.
constexpr std::chrono::microseconds shared_time{5000}, longest_turn{200}, shortest_turn{20};
constexpr milliseconds accept_pause{100};  // when not even one can be turned away
// Once the hub ends:
constexpr milliseconds last_patience{1000};  // with who reads nothing
constexpr milliseconds last_words{100};      // what is still on its way does not pause as long
constexpr milliseconds last_reading{500};    // from who floods

/// Processor time of this thread [s]. Time in which others had the processor is nobody's fault.
double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

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
      poller_(table_.limits().connections + 3) {
  waiting_.reserve(table_.limits().connections + most_arrivals + 1);
  if (!poller_.watch(wake_.get(), wake_number, EPOLLIN, false) ||
      !poller_.watch(listener_.descriptor(), listener_number, EPOLLIN, false))
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
  for (const epoll_event& event : poller_.wait(patience_ms(HubClock::now()))) note(event);
  const HubTime now = HubClock::now();
  if (accept_again_ && now >= *accept_again_) {
    accept_again_.reset();
    poller_.watch(listener_.descriptor(), listener_number, EPOLLIN, true);
  }
  if (somebody_arrives_ && !until_) accept_all(now);
  give_turns();
  settle(HubClock::now());
}

/// How long nothing needs to be done unless something happens [ms]; -1: for ever.
int HubLoop::patience_ms(HubTime now) const {
  if (more_to_understand_) return 0;
  std::optional<HubTime> due = next_due_;
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
    c->readable = gone || event.events & EPOLLIN;
    c->writable = event.events & EPOLLOUT;
    if (gone && !c->reading && c->unread.empty()) table_.end(*c);
  }
}

void HubLoop::accept_all(HubTime now) {
  for (int k = 0; k < most_arrivals; ++k) {
    HubListener::Arrival arrival = accept_one(now);
    if (arrival.outcome == HubListener::Outcome::nobody) return;
    if (arrival.outcome == HubListener::Outcome::no_descriptor) return pause_accepting(now);
    if (arrival.outcome == HubListener::Outcome::turned_away) continue;
    try {
      HubConnection& c = table_.admit(std::move(arrival.socket), now);
      c.readable = c.writable = true;  // to be greeted at once
    } catch (const std::bad_alloc&) {
      ++table_.counters().dropped(HubDrop::out_of_memory);
    }
  }
}

/// Where the process has no descriptor for a newcomer, a connection makes place for it. Where there
/// is none, or somebody else took what it left, the newcomer may be turned away.
HubListener::Arrival HubLoop::accept_one(HubTime now) {
  HubListener::Arrival arrival = listener_.accept();
  if (arrival.outcome != HubListener::Outcome::no_descriptor) return arrival;
  ++table_.counters().dropped(HubDrop::out_of_descriptors);
  if (table_.drop_least_useful(HubDrop::displaced, now)) {
    close_ended();
    arrival = listener_.accept();
    if (arrival.outcome != HubListener::Outcome::no_descriptor) return arrival;
  }
  return listener_.accept_with_reserve();
}

/// Who waits would be reported without end.
void HubLoop::pause_accepting(HubTime now) {
  poller_.watch(listener_.descriptor(), listener_number, 0, true);
  accept_again_ = now + accept_pause;
}

void HubLoop::give_turns() {
  const HubTime begin = HubClock::now();
  waiting_.clear();
  for (auto& [id, c] : table_.all()) {
    if (c.ended || !(c.readable || c.writable || !c.unread.empty())) continue;
    if (!c.waiting_since) c.waiting_since = begin;
    waiting_.emplace_back(turn_key(c.usage.at(begin), begin - *c.waiting_since), &c);
  }
  std::sort(waiting_.begin(), waiting_.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  const HubClock::duration turn = std::clamp<HubClock::duration>(
      shared_time / std::max<size_t>(waiting_.size(), 1), shortest_turn, longest_turn);
  HubTime now = begin;
  double processor = thread_seconds();
  for (auto& [key, c] : waiting_) {
    c->waiting_since.reset();
    exchange_.serve(*c, now, turn);
    now = HubClock::now();
    const double since = std::exchange(processor, thread_seconds());
    c->usage.add(processor - since, now);
    if (now - begin >= longest_round) break;
  }
}

void HubLoop::settle(HubTime now) {
  next_due_.reset();
  more_to_understand_ = false;
  for (auto& [id, c] : table_.all()) {
    c.readable = c.writable = false;
    const auto due = hub_due(c.standing, table_.limits());
    if (!c.ended && due && due->at <= now) table_.drop(c, due->why);
    if (!c.ended && until_) stop_reading(c, now);
    if (!c.ended) watch(c);
    if (c.ended) continue;
    more_to_understand_ |= !c.unread.empty();
    if (due) earliest(next_due_, due->at);
  }
  close_ended();
  table_.remove_ended();
  const std::lock_guard lock(shared_);
  counts_ = table_.counts();
}

void HubLoop::watch(HubConnection& c) {
  const uint32_t events =
      (c.reading ? uint32_t(EPOLLIN) : 0u) | (c.backlog.empty() ? 0u : uint32_t(EPOLLOUT));
  if (c.watched == events) return;
  if (poller_.watch(c.socket.get(), c.id, events, c.watched.has_value())) c.watched = events;
  else table_.drop(c, HubDrop::out_of_memory);
}

/// A child of the process may hold copies of its descriptors, so closing alone is not enough.
void HubLoop::close_ended() {
  for (auto& [id, c] : table_.all()) {
    if (!c.ended || !c.socket) continue;
    poller_.forget(c.socket.get());
    shutdown(c.socket.get(), SHUT_RDWR);
    c.socket.reset();
  }
}

void HubLoop::begin_to_finish(HubTime now) {
  {
    const std::lock_guard lock(shared_);
    if (!asked_to_finish_) return;
    until_ = asked_to_finish_;
  }
  if (listener_.descriptor() < 0) return;  // has begun before
  accept_all(now);
  poller_.forget(listener_.descriptor());
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
  for (auto& [id, c] : table_.all()) {
    if (!c.socket) continue;
    close_gently(c.socket.get());
    table_.end(c);
  }
  table_.remove_ended();
  const std::lock_guard lock(shared_);
  counts_ = table_.counts();
}

}  // namespace genio

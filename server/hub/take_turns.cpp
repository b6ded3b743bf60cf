#include "server/hub/take_turns.hpp"

#include <algorithm>
#include <ctime>
#include <utility>

namespace genio {
namespace {

constexpr std::chrono::microseconds longest_turn{200};

HubClock::duration thread_time() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

}  // namespace

ThreadStopwatch::ThreadStopwatch() : last_(thread_time()) {}

HubClock::duration ThreadStopwatch::lap() {
  const auto before = std::exchange(last_, thread_time());
  return last_ - before;
}

HubTurns::HubTurns(HubTable& table, HubExchange& exchange) : table_(table), exchange_(exchange) {
  waiting_.reserve(2 * table_.limits().connections + 64);
}

void HubTurns::queue(HubConnection& c, HubDirection& direction, bool ready, HubTime now) {
  if (!ready) return direction.waiting_since.reset();
  if (!direction.waiting_since) direction.waiting_since = now;
  const auto waited = now - *direction.waiting_since;
  waiting_.push_back({c.standing.favoured ? HubTurnKey::first()
                                          : HubTurnKey(direction.had_more, c.usage.at(now), waited),
                      &c, &direction});
}

/// Queues those who wait. Who is held back is not heard, but sent to.
void HubTurns::collect(HubTime now) {
  waiting_.clear();
  const bool resting = rests();
  for (auto& [id, c] : table_.all()) {
    if (c.ended || (resting && c.standing.uses_much)) continue;
    queue(c, c.in, (c.in.ready || !c.unread.empty()) && !c.standing.held_back, now);
    queue(c, c.out, c.out.ready && !c.backlog.empty(), now);
  }
}

void HubTurns::give(HubTime begin) {
  collect(begin);
  std::sort(waiting_.begin(), waiting_.end(),
            [](const Waiting& a, const Waiting& b) { return a.key < b.key; });
  const HubLimits& limits = table_.limits();
  const HubTurn turn =
      turn_of_many({longest_turn, limits.read_bytes, limits.sent_bytes}, waiting_.size());
  HubRound round(begin, !waiting_.empty() && waiting_.back().key.had_more);
  HubTime now = begin;
  ThreadStopwatch watch;
  for (const Waiting& w : waiting_) {
    if (!round.admits(w.key, now)) continue;
    HubConnection& c = *w.connection;
    w.direction->waiting_since.reset();
    if (w.direction == &c.in) exchange_.read_from(c, now, turn);
    else exchange_.send_to(c, now, turn);
    const HubTime end = HubClock::now();
    if (c.standing.uses_much) pace_.worked(end - now);
    now = end;
    c.usage.add(std::chrono::duration<double>(watch.lap()).count(), w.direction->had_more, now);
  }
}

bool HubTurns::more_to_understand() const {
  const auto& all = table_.all();
  return std::any_of(all.begin(), all.end(), [resting = rests()](const auto& entry) {
    const HubConnection& c = entry.second;
    return !c.ended && !c.unread.empty() && !c.standing.held_back &&
           !(resting && c.standing.uses_much);
  });
}

}  // namespace genio

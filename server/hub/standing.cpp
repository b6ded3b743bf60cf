#include "server/hub/standing.hpp"

namespace genio {
namespace {

constexpr std::chrono::milliseconds time_to_greet{100}, newcomers_time{1000};
constexpr double byte_s = 1e-6;  // so that the larger goes first among messages that just began

double seconds(HubClock::duration d) { return std::chrono::duration<double>(d).count(); }

void earlier(std::optional<HubDue>& due, HubTime at, HubDrop why) {
  if (!due || at < due->at) due = HubDue{at, why};
}

int rank(const HubStanding& s, HubTime now) {
  if (s.favoured) return 4;
  if (s.left || (!s.greeted && now - s.accepted > time_to_greet)) return 0;
  if (!s.took_part) return 1;
  return s.uses_much || s.held_back ? 2 : 3;
}

}  // namespace

HubTime newcomer_until(const HubStanding& s) { return s.accepted + newcomers_time; }

std::optional<HubDue> hub_due(const HubStanding& s, const HubLimits& limits) {
  std::optional<HubDue> due;
  if (!s.greeted) earlier(due, s.accepted + limits.greeting, HubDrop::not_greeted);
  if (s.partial) earlier(due, s.partial_grew + limits.partial, HubDrop::stalled);
  if (s.backlog_bytes > 0) earlier(due, s.drained + limits.draining, HubDrop::slow_reader);
  return due;
}

bool less_useful(const HubStanding& a, const HubStanding& b, HubTime now) {
  const int rank_a = rank(a, now), rank_b = rank(b, now);
  return rank_a != rank_b ? rank_a < rank_b : a.active < b.active;
}

double partial_burden(const HubStanding& s, HubTime now) {
  if (s.partial_bytes == 0) return 0;
  return double(s.partial_bytes) * (seconds(now - s.partial_began) + byte_s);
}

}  // namespace genio

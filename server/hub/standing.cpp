#include "server/hub/standing.hpp"

#include <algorithm>
#include <cmath>

namespace genio {
namespace {

constexpr std::chrono::milliseconds time_to_greet{100};
constexpr double usage_half_life_s = 1, most_used_s = 0.015, waited_share = 0.25;
constexpr double byte_s = 1e-6;  // so that the larger goes first among messages that just began

double seconds(HubClock::duration d) { return std::chrono::duration<double>(d).count(); }

void earlier(std::optional<HubDue>& due, HubTime at, HubDrop why) {
  if (!due || at < due->at) due = HubDue{at, why};
}

int rank(const HubStanding& s, HubTime now) {
  if (!s.greeted && now - s.accepted > time_to_greet) return 0;
  return s.took_part ? 2 : 1;
}

}  // namespace

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

void HubUsage::add(double more, HubTime now) {
  used_ = at(now) + more;
  at_ = now;
}

double HubUsage::at(HubTime now) const {
  return used_ * std::exp2(-seconds(now - at_) / usage_half_life_s);
}

double turn_key(double used_s, HubClock::duration waited) {
  return std::min(used_s, most_used_s) - waited_share * seconds(waited);
}

}  // namespace genio

#include "server/hub/turns/round.hpp"

#include <algorithm>
#include <utility>

namespace genio {
namespace {

using std::chrono::microseconds;

constexpr double most_used_s = 0.015, waited_share = 0.25;
constexpr microseconds longest_round{1000}, round_of_the_others{750};
constexpr microseconds shared_time{5000}, shortest_turn{20};
constexpr size_t least_bytes = 16 << 10;  // a call of the system has its price

size_t share_of(size_t bytes, double share) {
  return std::min(bytes, std::max(least_bytes, size_t(double(bytes) * share)));
}

}  // namespace

HubTurnKey::HubTurnKey(bool left_some, double used, HubClock::duration waited)
    : had_more(left_some),
      used_s(std::min(used, most_used_s) -
             waited_share * std::chrono::duration<double>(waited).count()) {}

HubTurn turn_of_many(const HubTurn& most, size_t waiting) {
  const HubClock::duration mine = shared_time / std::max<size_t>(waiting, 1);
  const auto time = std::min(most.time, std::max<HubClock::duration>(mine, shortest_turn));
  const double share = double(time.count()) / double(most.time.count());
  return {time, share_of(most.read_bytes, share), share_of(most.sent_bytes, share)};
}

bool HubRound::admits(const HubTurnKey& key, HubTime now) {
  bool& one = key.had_more ? one_with_more_had_turn_ : one_had_turn_;
  if (!std::exchange(one, true)) return true;
  const bool reserve = some_had_more_ && !key.had_more;
  return now - begin_ < (reserve ? round_of_the_others : longest_round);
}

}  // namespace genio

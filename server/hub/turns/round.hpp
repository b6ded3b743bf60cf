#pragma once
// Whose turn it is, and for how long. A round is some turns, after which the hub looks who else has
// something to say.

#include <compare>
#include <cstddef>

#include "server/hub/turns/usage.hpp"

namespace genio {

/// By which turns are given, the lowest first. Those whose last turn left nothing undone go before
/// those whose did, as floods always do. Among either, who used least goes first. What was used
/// counts up to 15 ms, less a quarter of the time waited, so that nobody waits for ever.
struct HubTurnKey {
  HubTurnKey(bool had_more, double used_s, HubClock::duration waited);
  /// Before all others.
  static HubTurnKey first() { return {false, -1e9, HubClock::duration(0)}; }
  auto operator<=>(const HubTurnKey&) const = default;

  bool had_more;
  double used_s;
};

/// How much may be done in a turn.
struct HubTurn {
  HubClock::duration time;  ///< what goes beyond is one message at most
  size_t read_bytes, sent_bytes;
};

/// How much may be done in a turn when so many wait. All who wait share some milliseconds, so that
/// the last of them waits no longer when there are more. `most`: for one that is alone.
HubTurn turn_of_many(const HubTurn& most, size_t waiting);

/// Says how long a round goes on. Those who had more left get a quarter of it at least.
class HubRound {
 public:
  /// `some_had_more`: there are such among those who wait.
  HubRound(HubTime begin, bool some_had_more) : begin_(begin), some_had_more_(some_had_more) {}

  /// True where a turn may begin now. The first of either kind always may.
  bool admits(const HubTurnKey& key, HubTime now);

 private:
  HubTime begin_;
  bool some_had_more_, one_had_turn_ = false, one_with_more_had_turn_ = false;
};

}  // namespace genio

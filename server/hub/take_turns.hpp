#pragma once
// Turns of a hub's connections.

#include <vector>

#include "server/hub/exchange.hpp"
#include "server/hub/turns/pace.hpp"
#include "server/hub/turns/round.hpp"

namespace genio {

/// Gives those who wait their turns, and accounts for the time that these take.
///
/// Turns are given in the order of HubTurnKey, and a round of them ends after a millisecond. So who
/// sends without end waits, and who sends now and then does not. Being read and being sent to are
/// turns of their own: a client that is flooded by others is heard as before.
class HubTurns {
 public:
  HubTurns(HubTable& table, HubExchange& exchange);

  /// One round.
  void give(HubTime now);
  /// While this is true, those who use much wait, and so do newcomers.
  bool rests() const { return pace_.rests(); }
  HubPace& pace() { return pace_; }
  const HubPace& pace() const { return pace_; }
  /// True where somebody has a turn to come that no event will tell of, as things stand now.
  bool more_to_understand() const;

 private:
  struct Waiting {
    HubTurnKey key;
    HubConnection* connection;
    HubDirection* direction;
  };
  void collect(HubTime now);
  void queue(HubConnection& c, HubDirection& direction, bool ready, HubTime now);

  HubTable& table_;
  HubExchange& exchange_;
  HubPace pace_;
  std::vector<Waiting> waiting_;
};

/// Measures the processor time of this thread. Time in which others had the processor is nobody's
/// fault.
class ThreadStopwatch {
 public:
  ThreadStopwatch();
  /// Since the last call, or the construction.
  HubClock::duration lap();

 private:
  HubClock::duration last_;
};

}  // namespace genio

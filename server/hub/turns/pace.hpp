#pragma once
#include "server/hub/turns/usage.hpp"

namespace genio {

/// Makes the hub rest as long as it worked for those who use much. While it rests it listens to all
/// others, and who floods it waits in the system's buffers. So a flood has the processor for half
/// of the time at most, and the hub's thread, the service and honest clients find one free. Where
/// others have the processor while the hub works, that counts as work: it rests more the less it
/// gets, and has it at once when somebody else has something to say.
///
/// Short rests are put together. Where the hub has nothing to do for half of the time, it never
/// rests.
class HubPace {
 public:
  /// Time that passed with work for those who use much.
  void worked(HubClock::duration time);
  /// Time in which the hub waited for events.
  void slept(HubClock::duration time);
  /// True while those who use much have no turn.
  bool rests() const { return rests_; }
  /// How much longer, when nothing else happens.
  HubClock::duration left() const { return owed_; }
  /// No rest from now on.
  void end() { rests_ = false, ended_ = true; }
  bool ended() const { return ended_; }

 private:
  HubClock::duration owed_{0};
  bool rests_ = false, ended_ = false;
};

}  // namespace genio

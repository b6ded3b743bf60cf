#pragma once
// Whom a hub parts with, and when. Pure functions of what it knows of each connection.

#include <cstddef>
#include <optional>

#include "server/hub/counts.hpp"
#include "server/hub/limits.hpp"
#include "server/hub/turns/usage.hpp"

namespace genio {

/// What a hub knows of a connection when it decides whom to part with.
struct HubStanding {
  bool greeted = false;
  bool took_part = false;  ///< has subscribed or published
  bool favoured = false;   ///< the service's own
  bool left = false;       ///< will send nothing more than what has come
  bool uses_much = false;  ///< and waits while the hub rests, see HubUsage
  bool held_back = false;  ///< not read from while much of it waits for the service
  HubTime accepted{};
  HubTime active{};          ///< last whole message from it, or byte taken by it
  size_t partial_bytes = 0;  ///< memory of what is not understood yet
  bool partial = false;      ///< a message has begun and is not whole
  HubTime partial_began{}, partial_grew{};
  size_t backlog_bytes = 0;
  HubTime drained{};  ///< since when what waits has not become less
};

/// Until when a connection is a newcomer: a second.
HubTime newcomer_until(const HubStanding& standing);
inline bool is_newcomer(const HubStanding& standing, HubTime now) {
  return now < newcomer_until(standing);
}

struct HubDue {
  HubTime at;
  HubDrop why;
};

/// When the hub parts with a connection of which nothing more is heard, and why; nothing where it
/// may stay as it is for ever.
std::optional<HubDue> hub_due(const HubStanding& standing, const HubLimits& limits);

/// True where `a` is to go before `b` when there are too many: first who has left or not greeted in
/// 100 ms, then who has neither subscribed nor published, then who uses much or is held back, then
/// who has been idle longest, and the service last. The 100 ms let a newcomer greet while others
/// keep on coming.
bool less_useful(const HubStanding& a, const HubStanding& b, HubTime now);

/// How much of the room for unfinished messages a connection has taken for how long [byte s]: the
/// one with most goes first. Who sends a message at once never takes much of it.
double partial_burden(const HubStanding& standing, HubTime now);

}  // namespace genio

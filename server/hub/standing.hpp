#pragma once
// Whom a hub parts with, and when. Pure functions of what it knows of each connection.

#include <chrono>
#include <cstddef>
#include <optional>

#include "server/hub/counts.hpp"
#include "server/hub/limits.hpp"

namespace genio {

using HubClock = std::chrono::steady_clock;
using HubTime = HubClock::time_point;

/// What a hub knows of a connection when it decides whom to part with.
struct HubStanding {
  bool greeted = false;
  bool took_part = false;  ///< has subscribed or published
  HubTime accepted{};
  HubTime active{};          ///< last whole message from it, or byte taken by it
  size_t partial_bytes = 0;  ///< memory of what is not understood yet
  bool partial = false;      ///< a message has begun and is not whole
  HubTime partial_began{}, partial_grew{};
  size_t backlog_bytes = 0;
  HubTime drained{};  ///< since when what waits has not become less
};

struct HubDue {
  HubTime at;
  HubDrop why;
};

/// When the hub parts with a connection of which nothing more is heard, and why; nothing where it
/// may stay as it is for ever.
std::optional<HubDue> hub_due(const HubStanding& standing, const HubLimits& limits);

/// True where `a` is to go before `b` when there are too many: first who has not greeted in 100 ms,
/// then who has neither subscribed nor published, then who has been idle longest. The 100 ms let a
/// newcomer greet while others keep on coming.
bool less_useful(const HubStanding& a, const HubStanding& b, HubTime now);

/// How much of the room for unfinished messages a connection has taken for how long [byte s]: the
/// one with most goes first. Who sends a message at once never takes much of it.
double partial_burden(const HubStanding& standing, HubTime now);

/// Processor time that a hub spent on a connection lately. What was used counts half after a
/// second. A newcomer begins with a little, so that many of them at once do not go before those who
/// have been here and use little.
class HubUsage {
 public:
  explicit HubUsage(HubTime accepted) : at_(accepted) {}
  void add(double seconds, HubTime now);
  /// [s]
  double at(HubTime now) const;

 private:
  double used_ = 5e-3;
  HubTime at_;
};

/// By which turns are given, the lowest first: what was used, but 15 ms at most, less a quarter of
/// the time waited [s]. So nobody waits longer than 40 ms for newcomers, however many there are.
double turn_key(double used_s, HubClock::duration waited);

}  // namespace genio

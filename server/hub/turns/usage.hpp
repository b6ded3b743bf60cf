#pragma once
#include <chrono>
#include <optional>

namespace genio {

using HubClock = std::chrono::steady_clock;
using HubTime = HubClock::time_point;

/// Processor time that a hub spent on a connection lately. What was used counts half after a
/// second. A newcomer begins with a little, so that many of them at once do not go before those who
/// have been here and use little.
class HubUsage {
 public:
  explicit HubUsage(HubTime accepted) : at_(accepted) {}
  /// `had_more`: there was more to do for it than its turn allowed.
  void add(double seconds, bool had_more, HubTime now);
  /// [s]
  double at(HubTime now) const;
  /// True for who had more to do than its turns allow in the last second, and used much besides, as
  /// floods do. It waits while the hub rests (HubPace). `before`: what was said before; it changes
  /// back only well below the limit, so that nobody goes to and fro.
  bool is_much(HubTime now, bool before) const;

 private:
  double used_ = 5e-3;
  HubTime at_;
  std::optional<HubTime> had_more_;
};

}  // namespace genio

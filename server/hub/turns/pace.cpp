#include "server/hub/turns/pace.hpp"

#include <algorithm>

namespace genio {
namespace {

// The system's clock for waiting counts milliseconds.
constexpr HubClock::duration shortest_rest = std::chrono::milliseconds(1),
                             longest_rest = std::chrono::milliseconds(10);

}  // namespace

void HubPace::worked(HubClock::duration time) {
  owed_ = std::min(owed_ + time, longest_rest);
  if (owed_ >= shortest_rest && !ended_) rests_ = true;
}

void HubPace::slept(HubClock::duration time) {
  owed_ = std::max(owed_ - time, HubClock::duration(0));
  if (owed_ == HubClock::duration(0)) rests_ = false;
}

}  // namespace genio

#pragma once
#include <algorithm>

#include "server/udpm/limits.hpp"

namespace genio {

/// How many bytes may be sent now: so many a second in the long run, and a burst after a pause.
class Pacer {
 public:
  Pacer(double bytes_per_s, size_t burst_bytes)
      : rate_(bytes_per_s), burst_(double(burst_bytes)), room_(burst_) {}

  bool is_free(UdpmTime now) const { return room_at(now) > 0; }
  /// When is_free() becomes true, if nothing is sent until then.
  UdpmTime free_at(UdpmTime now) const {
    const double room = room_at(now);
    if (room > 0) return now;
    const std::chrono::duration<double> wait((1 - room) / rate_);
    return now + std::chrono::ceil<UdpmClock::duration>(wait);
  }
  /// Also while it is not free: others wait longer then, by a burst at the most.
  void spend(size_t bytes, UdpmTime now) {
    room_ = std::max(room_at(now) - double(bytes), -burst_);
    updated_ = std::max(now, updated_);
  }

 private:
  double room_at(UdpmTime now) const {
    const std::chrono::duration<double> passed = std::max(now, updated_) - updated_;
    return std::min(room_ + rate_ * passed.count(), burst_);
  }

  double rate_, burst_, room_;  // [bytes/s], [bytes]
  UdpmTime updated_{};
};

}  // namespace genio

#pragma once
#include <cstdint>
#include <vector>

#include "genio/server_status_t.hpp"

namespace genio {

/// What a server has done since it started.
struct Tally {
  int64_t received = 0, computed = 0, replied = 0, refused = 0, failed = 0;
  int64_t past_deadline = 0, cancelled = 0, unreadable = 0;

  /// `seconds` from arrival to reply; the last thousand count.
  void add_latency(double seconds);
  /// Puts counts and quantiles into a status; NaN without a reply.
  void tell(server_status_t& status) const;

 private:
  std::vector<double> latencies_;
  size_t newest_ = 0;
};

}  // namespace genio

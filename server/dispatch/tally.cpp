#include "server/dispatch/tally.hpp"

#include <algorithm>
#include <cmath>

namespace genio {
namespace {

constexpr size_t most_latencies = 1000;

/// Of sorted values: the smallest that is not below a part `p` of them.
double quantile(const std::vector<double>& sorted, double p) {
  if (sorted.empty()) return std::nan("");
  return sorted[std::min(sorted.size() - 1, size_t(p * double(sorted.size())))];
}

}  // namespace

void Tally::add_latency(double seconds) {
  if (latencies_.size() < most_latencies) return latencies_.push_back(seconds);
  latencies_[newest_] = seconds;
  newest_ = (newest_ + 1) % most_latencies;
}

void Tally::tell(server_status_t& s) const {
  s.received = received, s.computed = computed, s.replied = replied, s.refused = refused;
  s.failed = failed, s.past_deadline = past_deadline, s.cancelled = cancelled;
  s.unreadable = unreadable;
  std::vector<double> sorted = latencies_;
  std::sort(sorted.begin(), sorted.end());
  s.latency_p50_s = quantile(sorted, 0.5), s.latency_p90_s = quantile(sorted, 0.9);
  s.latency_p99_s = quantile(sorted, 0.99);
}

}  // namespace genio

#include "server/metrics/status_figures.hpp"

namespace genio {

std::span<const StatusCounter> request_counters() {
  using S = server_status_t;
  static constexpr StatusCounter counters[] = {
      {"received", &S::received, "Requests that came."},
      {"computed", &S::computed, "Requests that were computed."},
      {"replied", &S::replied, "Replies that were sent, repeated ones too."},
      {"refused", &S::refused, "Replies that refused a request."},
      {"failed", &S::failed, "Computed requests without an answer."},
      {"past_deadline", &S::past_deadline, "Requests answered at their deadline."},
      {"cancelled", &S::cancelled, "Requests that their client withdrew."},
      {"replaced", &S::replaced, "Workers that crashed, hung or took too much memory."},
  };
  return counters;
}

std::span<const StatusCounter> message_drops() {
  using S = server_status_t;
  static constexpr StatusCounter counters[] = {
      {"unreadable", &S::unreadable, "Messages that do not decode."},
      {"unsigned", &S::unsigned_dropped, "Messages without the signature that is asked for."},
      {"forged", &S::forged_dropped, "Messages with a wrong signature."},
      {"stale", &S::stale_dropped, "Messages that are too old or were seen before."},
  };
  return counters;
}

const char* name_of(HubDrop why) {
  static constexpr const char* names[] = {"slow_reader", "not_greeted",        "stalled",
                                          "displaced",   "refused_pattern",    "too_large",
                                          "malformed",   "out_of_descriptors", "out_of_memory", "crowds_service"};
  static_assert(std::size(names) == size_t(HubDrop::count));
  return names[size_t(why)];
}

}  // namespace genio

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

std::span<const UdpmCounter> udpm_counters() {
  using C = UdpmCounts;
  static constexpr UdpmCounter counters[] = {
      {"udpm_datagrams_in", &C::datagrams_in, "Datagrams that came.", false},
      {"udpm_datagrams_out", &C::datagrams_out, "Datagrams that were sent.", false},
      {"udpm_overflowed", &C::overflowed, "Datagrams that found the receive buffer full.", true},
      {"udpm_parts_in", &C::parts_in, "Parts of larger messages that came.", false},
      {"udpm_repeated_parts", &C::repeated_parts, "Parts that were here already.", false},
      {"udpm_joined", &C::joined, "Messages in parts that came whole.", false},
      {"udpm_wrong_digests", &C::wrong_digests, "Whole messages with a wrong digest.", true},
      {"udpm_abandoned", &C::abandoned, "Unfinished messages that were too old.", true},
      {"udpm_evicted", &C::evicted, "Unfinished messages that others took the room of.", true},
      {"udpm_asks_in", &C::asks_in, "Times that others asked for missing parts.", false},
      {"udpm_asks_out", &C::asks_out, "Times that missing parts were asked for.", true},
      {"udpm_parts_out", &C::parts_out, "Parts of larger messages that were sent.", false},
      {"udpm_resent", &C::resent, "Parts that were sent again.", true},
      {"udpm_unsendable", &C::unsendable, "Messages that no datagrams can carry.", true},
  };
  return counters;
}

const char* name_of(UdpmDrop why) {
  static constexpr const char* names[] = {"not_lcm", "fragment", "bad_channel", "foreign",
                                          "bad_part"};
  static_assert(std::size(names) == size_t(UdpmDrop::count));
  return names[size_t(why)];
}

const char* name_of(HubDrop why) {
  static constexpr const char* names[] = {"slow_reader",   "not_greeted",        "stalled",
                                          "displaced",     "refused_pattern",    "too_large",
                                          "malformed",     "out_of_descriptors", "out_of_memory",
                                          "crowds_service"};
  static_assert(std::size(names) == size_t(HubDrop::count));
  return names[size_t(why)];
}

}  // namespace genio

#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace genio {

/// Why a hub parted with a connection, or did not take it.
enum class HubDrop {
  slow_reader,         ///< too much waited for it, or it took nothing for too long
  not_greeted,         ///< no greeting came in time
  stalled,             ///< a message did not go on, or filled the room for unfinished ones longest
  displaced,           ///< the least useful one when there was no place for a new one
  refused_pattern,     ///< a pattern that is none, is too long or costly, or is one too many
  too_large,           ///< a payload or channel above its limit
  malformed,           ///< what LCM does not say
  out_of_descriptors,  ///< the process had no descriptor for it
  out_of_memory,
  crowds_service,  ///< what it had sent to the service took most of the room for that
  count
};

/// What a hub has done and holds.
struct HubCounts {
  size_t connections = 0, subscriptions = 0;   ///< now
  size_t queued_bytes = 0, partial_bytes = 0;  ///< now; see HubLimits
  uint64_t accepted = 0;                       ///< connections
  uint64_t messages_in = 0, messages_out = 0;  ///< publications; out: once for each receiver
  uint64_t bytes_in = 0, bytes_out = 0;        ///< of the connections
  std::array<uint64_t, size_t(HubDrop::count)> drops{};

  uint64_t& dropped(HubDrop why) { return drops[size_t(why)]; }
  uint64_t dropped(HubDrop why) const { return drops[size_t(why)]; }
};

}  // namespace genio

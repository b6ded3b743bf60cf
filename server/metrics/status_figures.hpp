#pragma once
// The counts of a service and its hub, by name.

#include <span>

#include "genio/server_status_t.hpp"
#include "server/hub/counts.hpp"
#include "server/udpm/counts.hpp"

namespace genio {

/// A count of a status that only grows. `name` is that of the field.
struct StatusCounter {
  const char* name;
  int64_t server_status_t::*field;
  const char* help;
};
std::span<const StatusCounter> request_counters();
/// Messages that got no reply, by the reason.
std::span<const StatusCounter> message_drops();

/// A count of a connection over UDP multicast.
struct UdpmCounter {
  const char* name;
  uint64_t UdpmCounts::*field;
  const char* help;
  bool tells_of_trouble;  ///< it stands still where all is well
};
std::span<const UdpmCounter> udpm_counters();

const char* name_of(HubDrop why);
const char* name_of(UdpmDrop why);

}  // namespace genio

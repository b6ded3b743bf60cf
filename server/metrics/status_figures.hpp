#pragma once
// The counts of a service and its hub, by name.

#include <span>

#include "genio/server_status_t.hpp"
#include "server/hub/counts.hpp"

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

const char* name_of(HubDrop why);

}  // namespace genio

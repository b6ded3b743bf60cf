#include "server/observe/counts_event.hpp"

#include <span>
#include <utility>

namespace genio {
namespace {

void add_growth(std::vector<LogField>& fields, const char* name, int64_t growth) {
  if (growth != 0) fields.push_back({name, growth});
}

void add_growth(std::vector<LogField>& fields, std::span<const StatusCounter> counters,
                const server_status_t& before, const server_status_t& now) {
  for (const StatusCounter& c : counters)
    add_growth(fields, c.name, now.*c.field - before.*c.field);
}

void add_growth(std::vector<LogField>& fields, const LinkCounts& before, const LinkCounts& now) {
  add_growth(fields, "failed_handlings", int64_t(now.failed_handlings - before.failed_handlings));
  if (!now.udpm) return;
  const UdpmCounts old = before.udpm.value_or(UdpmCounts{});
  for (const UdpmCounter& c : udpm_counters())
    if (c.tells_of_trouble)
      add_growth(fields, c.name, int64_t((*now.udpm).*c.field - old.*c.field));
  for (size_t k = 0; k < old.drops.size(); ++k)
    add_growth(fields, name_of(UdpmDrop(k)), int64_t(now.udpm->drops[k] - old.drops[k]));
}

}  // namespace

std::optional<LogEvent> CountsEvent::due(const server_status_t& status, const HubCounts* hub,
                                         double now, const LinkCounts& link) {
  if (now - last_ < period_s_) return std::nullopt;
  const double span = now - std::exchange(last_, now);
  LogEvent event{LogKind::counts};
  add_growth(event.fields, request_counters(), before_, status);
  add_growth(event.fields, message_drops(), before_, status);
  before_ = status;
  add_growth(event.fields, std::exchange(link_before_, link), link);
  if (hub) {
    add_growth(event.fields, "connections", int64_t(hub->accepted - hub_before_.accepted));
    for (size_t k = 0; k < hub->drops.size(); ++k)
      add_growth(event.fields, name_of(HubDrop(k)), int64_t(hub->drops[k] - hub_before_.drops[k]));
    hub_before_ = *hub;
  }
  if (event.fields.empty()) return std::nullopt;
  event.fields.insert(event.fields.end(), {{"in_s", span},
                                           {"queued", int64_t(status.queued)},
                                           {"running", int64_t(status.running)},
                                           {"workers", int64_t(status.workers)},
                                           {"memory_mb", status.memory_mb}});
  return event;
}

}  // namespace genio

#pragma once
#include <optional>

#include "server/link/counts.hpp"
#include "server/log/log_event.hpp"
#include "server/metrics/status_figures.hpp"

namespace genio {

/// Once a minute, what was counted in it.
class CountsEvent {
 public:
  explicit CountsEvent(double period_s = 60) : period_s_(period_s) {}

  /// At most once a period: by how much each count has grown since the last time; only those that
  /// have, and nothing where none has. `hub`: nothing where there is no own hub. Of a connection
  /// over UDP multicast those that tell of trouble. `now` [s].
  std::optional<LogEvent> due(const server_status_t& status, const HubCounts* hub, double now,
                              const LinkCounts& link = {});

 private:
  double period_s_;
  double last_ = 0;
  server_status_t before_{};
  HubCounts hub_before_;
  LinkCounts link_before_;
};

}  // namespace genio

#pragma once
// What a service shows of itself, in one place.

#include <functional>
#include <optional>
#include <vector>

#include "forward/base/elapsed.hpp"
#include "server/log/log.hpp"
#include "server/metrics/metrics_endpoint.hpp"
#include "server/observe/counts_event.hpp"
#include "server/observe/service_events.hpp"
#include "server/observe/service_manager.hpp"

namespace genio {

/// Who is told; each may be missing, and outlives the observer.
struct Observing {
  Log* log = nullptr;
  MetricsEndpoint* metrics = nullptr;
  ServiceManager* manager = nullptr;
  std::function<HubCounts()> hub = {};  ///< of the server's own hub
  std::vector<LogField> facts = {};     ///< of how the server was started
};

/// Passes on what the service's loop tells: to the log, to scrapers of metrics, and to the manager
/// of services. Nothing here throws for what happens there, or waits for it, but for half a second
/// in stopping(). write() may be called from any thread, the rest from one.
class Observer {
 public:
  explicit Observer(Observing told = {}) : told_(std::move(told)) {}

  void write(const LogEvent& event) noexcept {
    if (told_.log) told_.log->write(event);
  }
  /// Once, when the first request would be answered at once.
  void serving(const server_status_t& status, const LinkCounts& link = {});
  /// Whenever a status is published: once a second. `link`: of the service's connection.
  void status(const server_status_t& status, const LinkCounts& link = {});
  /// Every turn of the loop; more often than half the watchdog's period.
  void turn();
  /// Once, as soon as the service is told to stop. turn() goes on while it drains.
  void stopping();
  /// Once, when nothing more happens.
  void stopped(const server_status_t& last, const DrainCounts& drain);

 private:
  Observing told_;
  Stopwatch clock_;
  CountsEvent counts_;
  std::optional<Stopwatch> draining_;
};

}  // namespace genio

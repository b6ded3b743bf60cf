#include "server/observe/observer.hpp"

#include <fmt/format.h>

#include "server/metrics/metrics_text.hpp"

namespace genio {
namespace {

std::string line_for_people(const server_status_t& s) {
  return fmt::format("{} running, {} queued, {} answered since the start", s.running, s.queued,
                     s.replied - s.refused);
}

}  // namespace

void Observer::serving(const server_status_t& status, const LinkCounts& link) {
  write(serving_event(status, told_.facts, clock_.seconds()));
  if (told_.manager) told_.manager->ready();
  this->status(status, link);
}

void Observer::status(const server_status_t& status, const LinkCounts& link) {
  const std::optional<HubCounts> hub = told_.hub ? std::optional(told_.hub()) : std::nullopt;
  const HubCounts* const own = hub ? &*hub : nullptr;
  if (told_.metrics) told_.metrics->publish(metrics_text(status, own, link));
  if (told_.manager && !draining_) told_.manager->say(line_for_people(status));
  if (const auto event = counts_.due(status, own, clock_.seconds(), link)) write(*event);
}

void Observer::turn() {
  if (told_.manager) told_.manager->turn(clock_.seconds());
}

void Observer::stopping() {
  draining_.emplace();
  if (!told_.manager) return;
  told_.manager->stopping();
  told_.manager->say("finishes what runs");
}

void Observer::stopped(const server_status_t& last, const DrainCounts& drain) {
  turn();
  write(stopped_event(last, drain, draining_ ? draining_->seconds() : 0));
}

}  // namespace genio

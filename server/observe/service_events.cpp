#include "server/observe/service_events.hpp"

#include <algorithm>

namespace genio {
namespace {

std::string joined(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ",") + name;
  return all;
}

/// Left out where there is nothing to say.
void add_text(LogEvent& event, const char* name, const std::string& text) {
  if (!text.empty()) event.fields.push_back({name, text});
}

}  // namespace

LogEvent serving_event(const server_status_t& s, std::vector<LogField> facts, double startup_s) {
  LogEvent event{LogKind::serving, LogLevel::info, {{"version", s.version}}};
  event.fields.push_back({"models", joined(s.model)});
  event.fields.push_back({"workers", int64_t(s.workers)});
  event.fields.push_back({"seconds", startup_s});
  event.fields.insert(event.fields.end(), facts.begin(), facts.end());
  return event;
}

DrainCounts drain_counts(const server_status_t& told, const server_status_t& last, bool journal) {
  DrainCounts drain;
  drain.refused = last.refused - told.refused;
  drain.finished = last.replied - told.replied - drain.refused;
  if (journal)
    drain.journalled =
        std::max<int64_t>(0, int64_t(told.queued) + told.running - drain.finished - drain.refused);
  return drain;
}

LogEvent stopped_event(const server_status_t& s, const DrainCounts& drain, double drain_s) {
  return {LogKind::stopped,
          LogLevel::info,
          {{"finished", drain.finished},
           {"journalled", drain.journalled},
           {"refused", drain.refused},
           {"seconds", drain_s},
           {"uptime_s", s.uptime_s},
           {"received", s.received},
           {"replied", s.replied},
           {"refused_in_all", s.refused}}};
}

LogEvent resumed_event(int64_t requests) {
  return {LogKind::resumed, LogLevel::info, {{"requests", requests}}};
}

LogEvent reply_event(const std::string& client, const command_reply_t& r) {
  if (r.status == "refused")
    return {LogKind::refused,
            LogLevel::info,
            {{"id", r.id}, {"client", client}, {"reason", r.message}}};
  LogEvent event{LogKind::answered, r.status == "failed" ? LogLevel::warning : LogLevel::info};
  event.fields = {{"id", r.id}, {"client", client}, {"status", r.status}};
  add_text(event, "verdict", r.verdict);
  if (!r.verdict.empty()) event.fields.push_back({"rms_mm", r.rms_mm});
  event.fields.push_back({"seconds", r.wall_s});
  event.fields.push_back({"waited_s", r.waited_s});
  if (r.tries > 1) event.fields.push_back({"tries", int64_t(r.tries)});
  add_text(event, "model", r.model);
  add_text(event, "reason", r.message);
  return event;
}

LogEvent dropped_event(const std::string& channel, size_t bytes, const std::string& reason) {
  return {LogKind::dropped,
          LogLevel::info,
          {{"channel", channel}, {"bytes", int64_t(bytes)}, {"reason", reason}}};
}

LogEvent worker_replaced_event(const std::string& id, const std::string& reason) {
  LogEvent event{LogKind::worker_replaced, LogLevel::warning};
  add_text(event, "id", id);
  event.fields.push_back({"reason", reason});
  return event;
}

LogEvent journal_failed_event(const std::string& reason) {
  return {LogKind::journal_failed, LogLevel::error, {{"reason", reason}}};
}

}  // namespace genio

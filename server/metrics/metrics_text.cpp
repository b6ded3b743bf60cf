#include "server/metrics/metrics_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "server/base/safe_text.hpp"
#include "server/metrics/status_figures.hpp"

namespace genio {
namespace {

std::string number_text(double value) {
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return value > 0 ? "+Inf" : "-Inf";
  return fmt::format("{}", value);
}

/// name="value" with what the format wants escaped. Bytes that are no printable sign stand as
/// \xNN, since a label must be UTF-8.
std::string label(std::string_view name, const std::string& value) {
  std::string result = fmt::format("{}=\"", name);
  for (const char c : escaped_text(value)) {
    if (c == '\\' || c == '"') result += '\\';
    result += c;
  }
  return result + '"';
}

class MetricsWriter {
 public:
  void family(std::string_view name, std::string_view type, std::string_view help) {
    name_ = fmt::format("genio_{}", name);
    text_ += fmt::format("# HELP {} {}\n# TYPE {} {}\n", name_, help, name_, type);
  }
  void sample(const std::string& labels, const std::string& number) {
    text_ += labels.empty() ? fmt::format("{} {}\n", name_, number)
                            : fmt::format("{}{{{}}} {}\n", name_, labels, number);
  }
  void gauge(std::string_view name, double value, std::string_view help) {
    family(name, "gauge", help);
    sample("", number_text(value));
  }
  template <class Integer>
  void counter(std::string_view name, Integer value, std::string_view help) {
    family(name, "counter", help);
    sample("", fmt::format("{}", value));
  }
  std::string text() && { return std::move(text_); }

 private:
  std::string name_, text_;
};

void write_identity(const server_status_t& s, MetricsWriter& out) {
  out.family("build_info", "gauge", "The program's version; always 1.");
  out.sample(label("version", s.version), "1");
  out.family("model_info", "gauge", "A model that is served, with the digest of its files.");
  for (size_t k = 0; k < s.model.size(); ++k) {
    const std::string hash = k < s.model_hash.size() ? s.model_hash[k] : "";
    out.sample(label("model", s.model[k]) + ',' + label("hash", hash), "1");
  }
  out.gauge("status_time_seconds", 1e-6 * double(s.utime),
            "When these figures were taken, in seconds since 1970.");
  out.gauge("uptime_seconds", s.uptime_s, "Since the server's start.");
  out.gauge("memory_bytes", 1e6 * s.memory_mb, "Resident, of the server's first process.");
}

void write_requests(const server_status_t& s, MetricsWriter& out) {
  out.gauge("queued", s.queued, "Requests that wait.");
  out.gauge("running", s.running, "Requests that are computed now.");
  out.gauge("workers", s.workers, "Worker processes that are there.");
  for (const StatusCounter& c : request_counters())
    out.counter(fmt::format("{}_total", c.name), s.*c.field, c.help);
  out.family("messages_dropped_total", "counter", "Messages that got no reply, by the reason.");
  for (const StatusCounter& c : message_drops())
    out.sample(label("reason", c.name), fmt::format("{}", s.*c.field));
  out.family("latency_seconds", "summary", "From arrival to reply, of the last 1000 replies.");
  out.sample(label("quantile", "0.5"), number_text(s.latency_p50_s));
  out.sample(label("quantile", "0.9"), number_text(s.latency_p90_s));
  out.sample(label("quantile", "0.99"), number_text(s.latency_p99_s));
}

void write_hub(const HubCounts& h, MetricsWriter& out) {
  out.gauge("hub_subscriptions", double(h.subscriptions), "Patterns of all connections.");
  out.gauge("hub_queued_bytes", double(h.queued_bytes), "What waits to be read by clients.");
  out.gauge("hub_partial_bytes", double(h.partial_bytes), "What has come of unfinished messages.");
  out.counter("hub_accepted_total", h.accepted, "Connections that were taken.");
  out.counter("hub_messages_in_total", h.messages_in, "Messages that clients published.");
  out.counter("hub_messages_out_total", h.messages_out, "Messages passed on, once a receiver.");
  out.counter("hub_bytes_in_total", h.bytes_in, "Bytes that clients sent.");
  out.counter("hub_bytes_out_total", h.bytes_out, "Bytes that clients were sent.");
  out.family("hub_drops_total", "counter",
             "Connections that the hub parted with or did not take, by the reason.");
  for (size_t k = 0; k < h.drops.size(); ++k)
    out.sample(label("reason", name_of(HubDrop(k))), fmt::format("{}", h.drops[k]));
}

void write_link(const LinkCounts& link, MetricsWriter& out) {
  out.counter("failed_handlings_total", link.failed_handlings,
              "Messages that ended in an error of the server itself.");
  if (!link.udpm) return;
  for (const UdpmCounter& c : udpm_counters())
    out.counter(fmt::format("{}_total", c.name), (*link.udpm).*c.field, c.help);
  out.family("udpm_drops_total", "counter", "Datagrams that were dropped, by the reason.");
  for (size_t k = 0; k < link.udpm->drops.size(); ++k)
    out.sample(label("reason", name_of(UdpmDrop(k))), fmt::format("{}", link.udpm->drops[k]));
}

}  // namespace

std::string metrics_text(const server_status_t& status, const HubCounts* hub,
                         const LinkCounts& link) {
  MetricsWriter out;
  write_identity(status, out);
  write_requests(status, out);
  out.gauge("hub_connections", double(status.hub_connections), "Connections of the own hub.");
  out.counter("hub_dropped_total", status.hub_dropped, "Connections that the own hub parted with.");
  write_link(link, out);
  if (hub) write_hub(*hub, out);
  return std::move(out).text();
}

}  // namespace genio

#include "server/metrics/metrics_text.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <regex>
#include <sstream>

#include "server/metrics/status_figures.hpp"
#include "tests/runs/temporary_folder.hpp"

namespace genio {
namespace {

server_status_t some_status() {
  server_status_t s{};
  s.utime = 1'700'000'000'250'000;
  s.version = "1.2.3";
  s.model_count = 2, s.model = {"generic", "a\"b\\c\nd\xff"},
  s.model_hash = {"0123456789abcdef", ""};
  s.queued = 101, s.running = 102, s.workers = 103, s.replaced = 104;
  s.received = 105, s.computed = 106, s.replied = 107, s.refused = 108, s.failed = 109;
  s.past_deadline = 110, s.cancelled = 111, s.unreadable = 112, s.unsigned_dropped = 113;
  s.forged_dropped = 114, s.stale_dropped = 115, s.hub_dropped = 116, s.hub_connections = 117;
  s.latency_p50_s = 0.25, s.latency_p90_s = 0.5, s.latency_p99_s = 0.75;
  s.memory_mb = 118, s.uptime_s = 119.5;
  return s;
}

HubCounts some_counts() {
  HubCounts h;
  h.subscriptions = 201, h.queued_bytes = 202, h.partial_bytes = 203, h.accepted = 204;
  h.messages_in = 205, h.messages_out = 206, h.bytes_in = 207, h.bytes_out = 208;
  for (size_t k = 0; k < h.drops.size(); ++k) h.drops[k] = 300 + k;
  return h;
}

LinkCounts some_link() {
  LinkCounts link{.failed_handlings = 400, .udpm = UdpmCounts{}};
  uint64_t value = 401;
  for (const UdpmCounter& c : udpm_counters()) (*link.udpm).*c.field = value++;
  for (uint64_t& drops : link.udpm->drops) drops = value++;
  return link;
}

struct Family {
  std::string type;
  std::map<std::string, std::string> samples;  ///< by labels
};

/// Reads the format as its specification has it, and complains of all else.
std::map<std::string, Family> read_metrics(const std::string& text) {
  static const std::regex help(R"(# HELP ([a-z_]+) [^\\\n]+\.)"), type(R"(# TYPE ([a-z_]+) (\w+))"),
      sample(
          R"re(([a-z_]+)(\{[a-z]+="([^"\\]|\\["\\n])*"(,[a-z]+="([^"\\]|\\["\\n])*")*\})? (\S+))re");
  std::map<std::string, Family> families;
  std::string current, helped;
  std::smatch m;
  EXPECT_TRUE(text.ends_with('\n'));
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (std::regex_match(line, m, help)) {
      helped = m[1];
    } else if (std::regex_match(line, m, type)) {
      current = m[1];
      EXPECT_EQ(current, helped);
      EXPECT_FALSE(families.contains(current)) << "twice: " << current;
      families[current].type = m[2];
    } else if (std::regex_match(line, m, sample)) {
      EXPECT_EQ(m[1], current) << line;
      EXPECT_TRUE(families[current].samples.emplace(m[2], m[6]).second) << line;
    } else {
      ADD_FAILURE() << "no line of the format: " << line;
    }
  }
  return families;
}

TEST(MetricsText, IsOfTheFormatAndEveryFamilyHasItsNameByItsType) {
  const HubCounts hub = some_counts();
  for (const HubCounts* own : {static_cast<const HubCounts*>(nullptr), &hub}) {
    for (const auto& [name, family] : read_metrics(metrics_text(some_status(), own, some_link()))) {
      EXPECT_TRUE(name.starts_with("genio_")) << name;
      EXPECT_EQ(name.ends_with("_total"), family.type == "counter") << name;
      EXPECT_TRUE(family.type == "counter" || family.type == "gauge" || family.type == "summary");
      EXPECT_FALSE(family.samples.empty()) << name;
    }
  }
}

TEST(MetricsText, HasEveryFigureOfTheStatusAndTheHub) {
  const HubCounts hub = some_counts();
  const std::string text = metrics_text(some_status(), &hub);
  for (int k = 101; k <= 117; ++k) EXPECT_NE(text.find(fmt::format(" {}\n", k)), text.npos) << k;
  for (int k = 201; k <= 208; ++k) EXPECT_NE(text.find(fmt::format(" {}\n", k)), text.npos) << k;
  for (size_t k = 300; k < 300 + hub.drops.size(); ++k)
    EXPECT_NE(text.find(fmt::format(" {}\n", k)), text.npos) << k;
  for (const char* line :
       {"genio_build_info{version=\"1.2.3\"} 1\n", "genio_uptime_seconds 119.5\n",
        "genio_memory_bytes 118000000\n", "genio_status_time_seconds 1700000000.25\n",
        "genio_latency_seconds{quantile=\"0.5\"} 0.25\n",
        "genio_latency_seconds{quantile=\"0.9\"} 0.5\n",
        "genio_latency_seconds{quantile=\"0.99\"} 0.75\n",
        "genio_messages_dropped_total{reason=\"forged\"} 114\n",
        "genio_hub_drops_total{reason=\"slow_reader\"} 300\n",
        "genio_model_info{model=\"generic\",hash=\"0123456789abcdef\"} 1\n"})
    EXPECT_NE(text.find(line), text.npos) << line << "is not in\n" << text;
}

TEST(MetricsText, HasEveryCountOfTheConnection) {
  const std::string text = metrics_text(some_status(), nullptr, some_link());
  // All fields of the counts are of 64 bits.
  const size_t last = 400 + sizeof(UdpmCounts) / sizeof(uint64_t);
  for (size_t k = 400; k <= last; ++k)
    EXPECT_NE(text.find(fmt::format(" {}\n", k)), text.npos) << k;
  EXPECT_NE(text.find("genio_failed_handlings_total 400\n"), text.npos);
  EXPECT_NE(text.find("genio_udpm_drops_total{reason=\"fragment\"}"), text.npos);
  EXPECT_EQ(metrics_text(some_status(), nullptr).find("udpm"), text.npos);
}

TEST(MetricsText, ALabelFromOutsideIsEscaped) {
  const auto families = read_metrics(metrics_text(some_status(), nullptr));
  EXPECT_TRUE(families.at("genio_model_info")
                  .samples.contains(R"({model="a\"b\\\\c\\x0ad\\xff",hash=""})"));
}

TEST(MetricsText, WhatIsNoNumberYetIsNaN) {
  server_status_t s = some_status();
  s.latency_p50_s = std::numeric_limits<double>::quiet_NaN();
  s.latency_p99_s = std::numeric_limits<double>::infinity();
  const auto samples = read_metrics(metrics_text(s, nullptr)).at("genio_latency_seconds").samples;
  EXPECT_EQ(samples.at("{quantile=\"0.5\"}"), "NaN");
  EXPECT_EQ(samples.at("{quantile=\"0.99\"}"), "+Inf");
}

TEST(MetricsText, AModelWithoutADigestIsListed) {
  server_status_t s = some_status();
  s.model = {"a", "b", "c"}, s.model_hash = {"01"};
  const auto samples = read_metrics(metrics_text(s, nullptr)).at("genio_model_info").samples;
  EXPECT_EQ(samples.size(), 3u);
  EXPECT_TRUE(samples.contains("{model=\"c\",hash=\"\"}"));
}

TEST(MetricsText, EveryNameIsInThePageOfOperating) {
  const std::string page = test::content_of(GENIO_SOURCE_DIR "/docs/operating.md");
  ASSERT_FALSE(page.empty());
  const HubCounts hub = some_counts();
  for (const auto& [name, family] : read_metrics(metrics_text(some_status(), &hub, some_link())))
    EXPECT_NE(page.find("| `" + name + "` | " + family.type + " |"), page.npos) << name;
}

}  // namespace
}  // namespace genio

#include "bench/figures/service/under_attack.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/figures/service/attackers.hpp"
#include "bench/figures/service/fresh_status.hpp"
#include "forward/base/elapsed.hpp"
#include "server/client.hpp"
#include "server/link/tcp_address.hpp"

namespace genio::bench {
namespace {

constexpr double longest_answer_s = 10;

struct Noticed {
  std::vector<double> status_ms;
  int asked = 0;
  double memory_mb = 0;
};

Noticed ask_for(Client& client, double seconds) {
  Noticed noticed;
  const Stopwatch all;
  while (all.seconds() < seconds) {
    const Stopwatch watch;
    ++noticed.asked;
    if (const auto status = fresh_status(client, longest_answer_s)) {
      noticed.status_ms.push_back(1e3 * watch.seconds());
      noticed.memory_mb = std::max(noticed.memory_mb, status->memory_mb);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  std::sort(noticed.status_ms.begin(), noticed.status_ms.end());
  return noticed;
}

double quantile(const std::vector<double>& sorted, double p) {
  return sorted.empty() ? 1e3 * longest_answer_s : sorted[size_t(p * double(sorted.size() - 1))];
}

}  // namespace

Json under_attack(const std::string& url, const shape_request_t& question, double seconds_each,
                  const Progress& progress) {
  Client client(url);
  client.status(longest_answer_s);
  Json figures;
  double most_mb = 0, worst = 0;
  for (const Attack& attack : all_attacks(question)) {
    Noticed noticed;
    double sent = 0;
    {
      const Attackers attackers(attack, local_tcpq_port(url));
      noticed = ask_for(client, seconds_each);
      sent = 1e-6 * double(attackers.sent_bytes());
    }
    const std::vector<double>& ms = noticed.status_ms;
    figures["attacks"][attack.name] = {
        {"status_ms_median", quantile(ms, 0.5)},        {"status_ms_p99", quantile(ms, 0.99)},
        {"status_ms_worst", quantile(ms, 1)},           {"asked", noticed.asked},
        {"unanswered", noticed.asked - int(ms.size())}, {"sent_mb", sent}};
    most_mb = std::max(most_mb, noticed.memory_mb);
    worst = std::max(worst, quantile(ms, 1));
    progress(fmt::format("{}: status within {:.1f} ms, 99 % within {:.1f} ms, {:.0f} MB",
                         attack.name, quantile(ms, 1), quantile(ms, 0.99), noticed.memory_mb));
  }
  figures["attacked_status_ms_worst"] = worst;
  figures["attacked_memory_mb"] = most_mb;
  return figures;
}

}  // namespace genio::bench

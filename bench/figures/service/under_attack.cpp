#include "bench/figures/service/under_attack.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <thread>

#include "bench/figures/service/attackers.hpp"
#include "bench/figures/service/fresh_status.hpp"
#include "forward/base/elapsed.hpp"
#include "server/client.hpp"
#include "server/link/tcp_address.hpp"

namespace genio::bench {
namespace {

constexpr double longest_answer_s = 10, longest_request_s = 60;

/// Times of asks for the status, in a row for so long [ms].
std::vector<double> ask_for(Client& client, double seconds) {
  std::vector<double> times;
  const Stopwatch all;
  while (all.seconds() < seconds) {
    const Stopwatch watch;
    const bool answered = fresh_status(client, longest_answer_s).has_value();
    times.push_back(1e3 * (answered ? watch.seconds() : longest_answer_s));
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  std::sort(times.begin(), times.end());
  return times;
}

/// How long a request takes [s]; `longest_request_s` where it is not answered.
double time_of_request(Client& client, const shape_request_t& question) {
  const Stopwatch watch;
  const auto reply = client.request(question, longest_request_s);
  return reply && reply->status == "converged" ? watch.seconds() : longest_request_s;
}

double quantile(const std::vector<double>& sorted, double p) {
  return sorted[size_t(p * double(sorted.size() - 1))];
}

Json notice(const Attack& attack, const std::string& url, Client& client,
            const shape_request_t& question, double seconds) {
  const Attackers attackers(attack, local_tcpq_port(url));
  double request_s = 0;
  std::thread requesting([&] {
    Client other(url);
    request_s = time_of_request(other, question);
  });
  const std::vector<double> ms = ask_for(client, seconds);
  requesting.join();
  const auto unanswered = std::count(ms.begin(), ms.end(), 1e3 * longest_answer_s);
  return {{"status_ms_median", quantile(ms, 0.5)},
          {"status_ms_p99", quantile(ms, 0.99)},
          {"status_ms_worst", ms.back()},
          {"asked", ms.size()},
          {"unanswered", unanswered},
          {"request_s", request_s},
          {"sent_mb", 1e-6 * double(attackers.sent_bytes())}};
}

}  // namespace

Json under_attack(const ServerProcess& server, const shape_request_t& question, double seconds_each,
                  const Progress& progress) {
  Client client(server.url());
  client.status(longest_answer_s);
  Json figures;
  double worst = 0;
  for (const Attack& attack : all_attacks(question)) {
    Json noticed = notice(attack, server.url(), client, question, seconds_each);
    noticed["memory_mb"] = server.peak_mb();
    const auto value = [&](const char* name) { return noticed[name].get<double>(); };
    worst = std::max(worst, value("status_ms_worst"));
    progress(
        fmt::format("{}: status within {:.1f} ms, 99 % within {:.1f} ms, a request {:.1f} s, "
                    "{:.0f} MB",
                    attack.name, value("status_ms_worst"), value("status_ms_p99"),
                    value("request_s"), value("memory_mb")));
    figures["attacks"][attack.name] = std::move(noticed);
  }
  figures["attacked_status_ms_worst"] = worst;
  figures["attacked_memory_mb"] = server.peak_mb();
  return figures;
}

}  // namespace genio::bench

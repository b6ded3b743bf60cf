#include "bench/figures/service/round_trips.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "bench/figures/service/fresh_status.hpp"
#include "forward/base/elapsed.hpp"
#include "server/client.hpp"

namespace genio::bench {
namespace {

constexpr double patience_s = 120;

double quantile_of(std::vector<double> values, double p) {
  if (values.empty()) throw std::runtime_error("no reply came");
  std::sort(values.begin(), values.end());
  return values[size_t(p * double(values.size() - 1))];
}

/// Work of several clients at once, each in a thread of its own.
void together(const std::string& url, int clients, const std::function<void(Client&, int)>& work) {
  std::vector<std::thread> threads;
  for (int k = 0; k < clients; ++k)
    threads.emplace_back([&, k] {
      Client client(url);
      work(client, k);
    });
  for (std::thread& t : threads) t.join();
}

}  // namespace

Json overheads(const std::string& url, const std::vector<shape_request_t>& questions, int count) {
  Client client(url);
  client.status(patience_s);
  std::vector<double> overhead;
  double first_mb = 0;
  for (int k = 0; k < count; ++k) {
    const Stopwatch watch;
    const auto reply = client.request(questions[size_t(k) % questions.size()], patience_s);
    if (reply) overhead.push_back(1e3 * (watch.seconds() - reply->wall_s));
    if (k == count / 10)
      if (const auto s = client.status(patience_s)) first_mb = s->memory_mb;
  }
  const auto last = client.status(patience_s);
  return {{"overhead_ms_median", quantile_of(overhead, 0.5)},
          {"overhead_ms_p99", quantile_of(overhead, 0.99)},
          {"memory_mb_first", first_mb},
          {"memory_mb_last", last ? last->memory_mb : std::nan("")}};
}

Json memory_of_many(const std::string& url, const shape_request_t& question, int count) {
  Client client(url);
  client.status(patience_s);
  double first_mb = 0;
  int replies = 0;
  const auto memory_mb = [&] {
    const auto s = fresh_status(client, patience_s);
    return s ? s->memory_mb : std::nan("");
  };
  for (int k = 0; k < count; ++k) {
    shape_request_t r = question;
    r.deadline_s = 4e-3;
    replies += client.request(r, patience_s).has_value();
    if (k == count / 10) first_mb = memory_mb();
  }
  return {
      {"memory_replies", replies}, {"memory_mb_first", first_mb}, {"memory_mb_last", memory_mb()}};
}

double throughput(const std::string& url, const std::vector<shape_request_t>& questions,
                  int clients, int each) {
  Client(url).status(patience_s);
  std::atomic<int> replies{0};
  const Stopwatch watch;
  together(url, clients, [&](Client& client, int c) {
    for (int k = 0; k < each; ++k)
      replies += client.request(questions[size_t(c * each + k) % questions.size()], patience_s)
                     .has_value();
  });
  return replies / watch.seconds();
}

Json deadlines(const std::string& url, const shape_request_t& question, int count, unsigned seed) {
  constexpr int clients = 20;
  constexpr double shortest_s = 0.02, longest_s = 5;
  Client(url).status(patience_s);
  std::mutex mutex;
  std::vector<double> late;
  int met = 0;
  together(url, clients, [&](Client& client, int c) {
    std::mt19937 random(seed * 1000 + unsigned(c));
    std::uniform_real_distribution<double> part;
    for (int k = c; k < count; k += clients) {
      shape_request_t r = question;
      r.deadline_s = shortest_s * std::pow(longest_s / shortest_s, part(random));
      const Stopwatch watch;
      const auto reply = client.request(r, patience_s);
      const double took = watch.seconds();
      const std::lock_guard lock(mutex);
      met += reply && reply->status == "deadline" &&
             took <= std::max(1.1 * r.deadline_s, r.deadline_s + 0.05);
      late.push_back(1e3 * (took - r.deadline_s));
    }
  });
  return {{"deadlines", count},
          {"deadlines_met", double(met) / count},
          {"deadline_late_ms_p99", quantile_of(late, 0.99)}};
}

Json beside_long(const std::string& url, const shape_request_t& lasting,
                 const std::vector<shape_request_t>& questions) {
  Client client(url), other(url);
  client.status(patience_s);
  double longest = 0;
  std::vector<double> status_ms;
  std::thread computing([&] {
    shape_request_t r = lasting;
    r.deadline_s = 5;
    other.request(r, patience_s);
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  for (size_t k = 0; k < std::min<size_t>(10, questions.size()); ++k) {
    if (const auto reply = client.request(questions[k], patience_s))
      longest = std::max(longest, 1e3 * reply->waited_s);
    for (int n = 0; n < 10; ++n) {
      const Stopwatch watch;
      fresh_status(client, patience_s);
      status_ms.push_back(1e3 * watch.seconds());
    }
  }
  computing.join();
  return {{"short_waited_ms", longest},
          {"status_ms_median", quantile_of(status_ms, 0.5)},
          {"status_ms_p99", quantile_of(status_ms, 0.99)}};
}

}  // namespace genio::bench

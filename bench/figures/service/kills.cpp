#include "bench/figures/service/kills.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <fstream>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "bench/figures/service/questions.hpp"
#include "forward/base/elapsed.hpp"
#include "server/client.hpp"

namespace genio::bench {
namespace {

constexpr double asks_for_s = 1800;

/// What the clients saw.
struct Seen {
  std::mutex mutex;
  std::map<std::string, int64_t> replied_us;  // by id
  int wrong = 0;
};

/// Computations that ended after their request's reply had come to its client.
int64_t recomputed_after(const std::string& computed, const std::map<std::string, int64_t>& times) {
  int64_t count = 0, at = 0;
  std::ifstream in(computed);
  for (std::string id; in >> at >> id;)
    if (const auto reply = times.find(id); reply != times.end()) count += at > reply->second;
  return count;
}

std::vector<command_reply_t> answers_undisturbed(const std::string& url,
                                                 const std::vector<shape_request_t>& questions) {
  Client client(url, "reference");
  std::vector<command_reply_t> answers;
  for (const shape_request_t& q : questions) {
    const auto reply = client.request(q, asks_for_s);
    if (!reply || reply->status != "converged")
      throw std::runtime_error("a question has no answer");
    answers.push_back(*reply);
  }
  return answers;
}

}  // namespace

Json killed_service(ServerProcess& server, const std::string& computed,
                    const std::vector<shape_request_t>& questions, const KillPlan& plan,
                    const Progress& progress) {
  const auto expected = answers_undisturbed(server.url(), questions);
  Seen seen;
  std::atomic<int> replies{0}, working{plan.clients};
  std::vector<std::thread> clients;
  for (int c = 0; c < plan.clients; ++c)
    clients.emplace_back([&, c] {
      Client client(server.url(), fmt::format("soak{}", c));
      for (int k = c; k < plan.requests; k += plan.clients) {
        shape_request_t r = questions[size_t(k) % questions.size()];
        r.id = fmt::format("soak-{}-{}", plan.seed, k);
        const auto reply = client.request(r, asks_for_s);
        if (!reply) continue;
        ++replies;
        const std::lock_guard lock(seen.mutex);
        seen.replied_us[r.id] = now_us();
        seen.wrong += !same_answer(*reply, expected[size_t(k) % questions.size()]);
      }
      --working;
    });
  std::mt19937 random(plan.seed);
  int worker_kills = 0, server_kills = 0;
  double next_kill = plan.worker_kill_s, next_word = 10;
  const Stopwatch watch;
  while (working > 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    const bool due = replies >= plan.requests * (server_kills + 1) / (plan.server_kills + 1);
    if (server_kills < plan.server_kills && due && working > 0)
      server.kill(), server.start(), ++server_kills;
    if (watch.seconds() >= next_kill) {
      next_kill = watch.seconds() + plan.worker_kill_s;
      const auto workers = server.workers();
      if (!workers.empty())
        worker_kills += ::kill(workers[random() % workers.size()], SIGKILL) == 0;
    }
    if (watch.seconds() >= next_word) {
      next_word += 10;
      progress(fmt::format("{} of {} replies, {} workers and {} servers killed", replies.load(),
                           plan.requests, worker_kills, server_kills));
    }
  }
  for (std::thread& t : clients) t.join();
  return {
      {"requests", plan.requests},    {"replies", replies.load()},
      {"wrong", seen.wrong},          {"recomputed", recomputed_after(computed, seen.replied_us)},
      {"worker_kills", worker_kills}, {"server_kills", server_kills},
      {"seconds", watch.seconds()}};
}

}  // namespace genio::bench

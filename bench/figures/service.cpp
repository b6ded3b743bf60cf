#include "bench/figures/service.hpp"

#include <fmt/format.h>

#include <atomic>
#include <nlohmann/json.hpp>
#include <thread>

#include "forward/base/elapsed.hpp"
#include "server/client.hpp"
#include "server/hub/hub.hpp"
#include "server/served_model.hpp"
#include "server/service.hpp"

namespace genio::bench {
namespace {

Json run_service(const BenchOptions& o, const Progress&) {
  std::vector<ServedModel> models = read_served_models({o.model});
  const Model& m = *models.front().model;
  const Nursery nursery(worker_of(models, 2000));
  const Hub hub(0);
  ServiceOptions options;
  options.url = fmt::format("tcpq://127.0.0.1:{}", hub.port());
  std::atomic<bool> stop{false};
  std::thread server([&] { serve(nursery, identities(models), options, stop); });
  std::vector<double> overhead;
  int requests = 0, replies = 0;
  {
    Client client(options.url);
    client.status(5);
    for (int i = 0; i < 40; ++i) {
      shape_request_t r{};
      r.point_count = 1;
      r.x_mm = {1e3 * m.mesh.nodes[size_t(m.landmarks.dorsum)][0]};
      r.y_mm = {0};
      r.z_mm = {1e3 * m.mesh.nodes[size_t(m.landmarks.dorsum)][2]};
      r.sigma_mm = {1};
      r.kind = {"dorsum"};
      r.bilateral = 1;
      const Stopwatch watch;
      const auto reply = client.request(r, 60);
      ++requests;
      if (!reply) continue;
      ++replies;
      overhead.push_back(1e3 * (watch.seconds() - reply->wall_s));
    }
  }
  stop = true;
  server.join();
  std::sort(overhead.begin(), overhead.end());
  if (overhead.empty()) throw std::runtime_error("no reply came");
  return {{"requests", requests},
          {"replies", replies},
          {"overhead_ms_median", overhead[overhead.size() / 2]},
          {"overhead_ms_p99", overhead.back()}};
}

}  // namespace

Benchmark service_bench() {
  return {.name = "service",
          .about = "Round trips over LCM on 127.0.0.1 beside the bare computation",
          .run = run_service};
}

}  // namespace genio::bench

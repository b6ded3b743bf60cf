#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/commands.hpp"
#include "forward/model_file.hpp"
#include "inverse/infer.hpp"
#include "server/client.hpp"
#include "server/hub.hpp"
#include "server/service.hpp"

namespace genio::cli {
namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Curve target simulated with known forces, without noise.
Target simulated(const Model& m, const std::vector<std::pair<std::string, double>>& forces, Workspace& ws) {
  Parameters p = default_parameters(m);
  for (const auto& [name, newtons] : forces) set_command(m, name, newtons, p);
  const auto e = solve_equilibrium(m, p, m.rest, ws);
  if (!e) throw std::runtime_error("the bench target has no equilibrium: " + e.message);
  Target t;
  for (const Vec2& q : TongueLine(m).sample(e.x, 40)) t.curve.push_back({q, 0.5e-3});
  return t;
}

nlohmann::json bench_recovery(const Model& m) {
  Workspace ws(m);
  const std::vector<std::vector<std::pair<std::string, double>>> truths = {
      {{"GGP", 2.8}, {"SL", 1.2}, {"GH", 0.9}},
      {{"HG", 3.0}, {"GGA", 1.0}, {"VERT", 1.5}},
      {{"STY", 1.5}, {"GGM", 0.8}, {"TRANS", 2.0}},
      {{"IL", 0.5}, {"GGP", 2.0}, {"TRANS", 1.5}}};
  nlohmann::json list = nlohmann::json::array();
  for (const auto& truth : truths) {
    Target target = simulated(m, truth, ws);
    const Answer cold = infer(m, target, Prior{}, ws);
    // A frame later: everything half a millimetre on.
    for (auto& p : target.curve) p.position += Vec2(0.2e-3, 0.45e-3);
    InferOptions warm;
    warm.start = cold.activations, warm.start_shape = cold.shape;
    const Answer next = infer(m, target, Prior{}, ws, warm);
    std::string name;
    for (const auto& [muscle, force] : truth) name += fmt::format("{}={} ", muscle, force);
    list.push_back({{"truth", name}, {"status", to_string(cold.status)}, {"rms_mm", 1e3 * cold.rms},
                    {"cold_s", cold.wall_s}, {"cold_factorizations", cold.factorizations},
                    {"warm_status", to_string(next.status)}, {"warm_s", next.wall_s},
                    {"warm_factorizations", next.factorizations}});
  }
  return {{"recovery", list}};
}

nlohmann::json bench_service(const Model& m) {
  const Hub hub(0);
  ServiceOptions options;
  options.url = fmt::format("tcpq://127.0.0.1:{}", hub.port());
  std::atomic<bool> stop{false};
  std::thread server([&] { serve(m, options, stop); });
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
      const auto start = Clock::now();
      const auto reply = client.request(r, 60);
      ++requests;
      if (!reply) continue;
      ++replies;
      overhead.push_back(1e3 * (since(start) - reply->wall_s));
    }
  }
  stop = true;
  server.join();
  std::sort(overhead.begin(), overhead.end());
  if (overhead.empty()) throw std::runtime_error("no reply came");
  return {{"requests", requests}, {"replies", replies},
          {"overhead_ms_median", overhead[overhead.size() / 2]},
          {"overhead_ms_p99", overhead.back()}};
}

}  // namespace

Runner add_bench(CLI::App& app) {
  auto model = std::make_shared<std::string>(default_model());
  auto what = std::make_shared<std::string>();
  auto json = std::make_shared<bool>(false);
  app.add_option("what", *what, "inverse or service")->required()->check(CLI::IsMember({"inverse", "service"}));
  app.add_option("--model", *model, "Model folder or model.toml");
  app.add_flag("--json", *json, "One JSON object on standard output");
  app.footer("Example: genio bench inverse");
  return [=]() -> int {
    const Model m = read_model(*model);
    const auto j = *what == "inverse" ? bench_recovery(m) : bench_service(m);
    fmt::print("{}\n", *json ? j.dump() : j.dump(2));
    return done;
  };
}

}  // namespace genio::cli

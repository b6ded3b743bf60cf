#include <fmt/format.h>

#include "bench/benchmarks.hpp"
#include "inverse/infer.hpp"

namespace genio::bench {
namespace {

/// Curve target simulated with known forces, without noise.
Target simulated(const Model& m, const std::vector<std::pair<std::string, double>>& forces,
                 Workspace& ws) {
  Parameters p = default_parameters(m);
  for (const auto& [name, newtons] : forces) set_command(m, name, newtons, p);
  const auto e = solve_equilibrium(m, p, m.rest, ws);
  if (!e) throw std::runtime_error("the bench target has no equilibrium: " + e.message);
  return curve_target(m, e.x, 40, 0.5e-3);
}

}  // namespace

Json recovery(const Model& m) {
  Workspace ws(m);
  const std::vector<std::vector<std::pair<std::string, double>>> truths = {
      {{"GGP", 2.8}, {"SL", 1.2}, {"GH", 0.9}},
      {{"HG", 3.0}, {"GGA", 1.0}, {"VERT", 1.5}},
      {{"STY", 1.5}, {"GGM", 0.8}, {"TRANS", 2.0}},
      {{"IL", 0.5}, {"GGP", 2.0}, {"TRANS", 1.5}}};
  Json list = Json::array();
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
    list.push_back({{"truth", name},
                    {"status", to_string(cold.status)},
                    {"rms_mm", 1e3 * cold.rms},
                    {"cold_s", cold.wall_s},
                    {"cold_factorizations", cold.factorizations},
                    {"warm_status", to_string(next.status)},
                    {"warm_s", next.wall_s},
                    {"warm_factorizations", next.factorizations}});
  }
  return {{"recovery", list}};
}

}  // namespace genio::bench

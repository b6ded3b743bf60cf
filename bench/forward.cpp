#include <algorithm>
#include <chrono>

#include "bench/benchmarks.hpp"
#include "bench/block.hpp"
#include "forward/equilibrium.hpp"

namespace genio::bench {
namespace {

double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median_of(int times, const std::function<void()>& work) {
  std::vector<double> t;
  for (int i = 0; i < times; ++i) t.push_back(seconds(work));
  std::sort(t.begin(), t.end());
  return t[t.size() / 2];
}

/// A static solve of `m` in units of one factorisation of its tangent.
Json measure(const Model& m, int repeats) {
  const Parameters p = default_parameters(m);
  Parameters near = p;
  near[parameter_index(m, "load.force")] *= 1.05;
  Equilibrium cold, warm;
  std::vector<double> cold_s, warm_s, factor_s;
  double analyse_s = 0;
  for (int i = 0; i < repeats; ++i) {
    std::unique_ptr<Workspace> ws;
    analyse_s = seconds([&] { ws = std::make_unique<Workspace>(m); });
    cold_s.push_back(seconds([&] { cold = solve_equilibrium(m, p, m.rest, *ws); }));
    warm_s.push_back(seconds([&] { warm = solve_equilibrium(m, near, cold.x, *ws); }));
    stiffness(m, cold.x, p, ws->stiffness);
    ws->reduced.assign(ws->stiffness);
    factor_s.push_back(median_of(5, [&] { ws->cholesky.factorize(ws->reduced); }));
  }
  for (auto* v : {&cold_s, &warm_s, &factor_s}) std::sort(v->begin(), v->end());
  const size_t mid = size_t(repeats / 2);
  return {{"unknowns", m.dofs.unknowns()},
          {"elements", m.mesh.elements.size()},
          {"status", cold && warm ? "converged" : "failed"},
          {"factor_ms", 1e3 * factor_s[mid]},
          {"analyse_ms", 1e3 * analyse_s},
          {"cold_ms", 1e3 * cold_s[mid]},
          {"warm_ms", 1e3 * warm_s[mid]},
          {"cold_over_factor", cold_s[mid] / factor_s[mid]},
          {"warm_over_factor", warm_s[mid] / factor_s[mid]},
          {"cold_factorizations", cold.factorizations},
          {"warm_factorizations", warm.factorizations},
          {"cold_newton", cold.newton_iterations}};
}

}  // namespace

Json forward(const Progress&) {
  const Model m = block(1);
  Json j = measure(m, 7);
  Workspace ws(m);
  const Equilibrium e = solve_equilibrium(m, default_parameters(m), m.rest, ws);
  const int top = top_centre(1);
  const Vec3 u = 1e3 * (node_position(e.x, top) - node_position(m.rest, top));
  j["top_centre_mm"] = {u[0], u[1], u[2]};
  return j;
}

}  // namespace genio::bench

#include "bench/figures/forward/forward.hpp"

#include <malloc.h>
#include <sys/resource.h>

#include <cmath>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench/problems/block.hpp"
#include "bench/problems/calculix.hpp"
#include "bench/problems/clock.hpp"
#include "forward/statics/equilibrium.hpp"

namespace genio::bench {
namespace {

/// Largest resident set since the last call [MiB].
double peak_memory() {
  double peak = 0;
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) peak = std::strtod(line.c_str() + 6, nullptr) / 1024;
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << 5;
  return peak;
}

/// A static solve of `m` in units of one factorisation of its tangent.
Json measure(const Model& m, int repeats) {
  const Parameters p = default_parameters(m);
  Parameters near = p;
  near[parameter_index(m, "load.force")] *= 1.05;
  Equilibrium cold, warm;
  std::vector<double> cold_s, warm_s, factor_s;
  double analyse_s = 0, flops = 0;
  peak_memory();
  for (int i = 0; i < repeats; ++i) {
    std::unique_ptr<Workspace> ws;
    analyse_s = seconds([&] { ws = std::make_unique<Workspace>(m); });
    cold_s.push_back(seconds([&] { cold = solve_equilibrium(m, p, m.rest, *ws); }));
    warm_s.push_back(seconds([&] { warm = solve_equilibrium(m, near, cold.x, *ws); }));
    stiffness(m, cold.x, p, ws->stiffness);
    ws->reduced.assign(ws->stiffness);
    factor_s.push_back(median_seconds(5, [&] { ws->cholesky.factorize(ws->reduced); }));
    flops = ws->cholesky.flops();
  }
  const double factor = median(factor_s), cold_median = median(cold_s),
               warm_median = median(warm_s);
  return {{"unknowns", m.dofs.unknowns()},
          {"elements", m.mesh.elements.size()},
          {"status", cold && warm ? "converged" : "failed"},
          {"factor_ms", 1e3 * factor},
          {"factor_gflops", 1e-9 * flops / factor},
          {"analyse_ms", 1e3 * analyse_s},
          {"cold_ms", 1e3 * cold_median},
          {"warm_ms", 1e3 * warm_median},
          {"cold_over_factor", cold_median / factor},
          {"warm_over_factor", warm_median / factor},
          {"cold_factorizations", cold.factorizations},
          {"warm_factorizations", warm.factorizations},
          {"cold_newton", cold.newton_iterations},
          {"peak_memory_MiB", peak_memory()}};
}

Json run_forward(const BenchOptions&, const Progress& progress) {
  const Model m = block(1);
  progress("block of 960 elements");
  Json j = measure(m, 7);
  Workspace ws(m);
  const Equilibrium e = solve_equilibrium(m, default_parameters(m), m.rest, ws);
  const int top = top_centre(1);
  const Vec3 u = 1e3 * (node_position(e.x, top) - node_position(m.rest, top));
  j["top_centre_mm"] = {u[0], u[1], u[2]};
  progress("CalculiX on the same block");
  j["calculix_ratio"] = nullptr;
  if (const auto peer = run_calculix(block_for_calculix(m, 1.0))) {
    const Vec3 v = 1e3 * (node_position(peer->x, top) - node_position(m.rest, top));
    j["calculix_s"] = peer->cpu_s;
    j["calculix_ratio"] = 1e3 * peer->cpu_s / j["cold_ms"].get<double>();
    j["calculix_c3d8_top_centre_mm"] = {v[0], v[1], v[2]};
  }
  // Larger blocks of the same shape: 4 480 elements as other codes were timed on, and 18 304.
  j["larger"] = Json::array();
  for (const auto& cells : {std::array{20, 14, 16}, {32, 22, 26}}) {
    progress("block of " + std::to_string(cells[0] * cells[1] * cells[2]) + " elements");
    Json larger = measure(block(cells), 1);
    larger["growth_exponent"] =
        std::log(larger["cold_ms"].get<double>() / j["cold_ms"].get<double>()) /
        std::log(larger["elements"].get<double>() / j["elements"].get<double>());
    j["larger"].push_back(std::move(larger));
  }
  return j;
}

}  // namespace

Benchmark forward_bench() {
  return {.name = "forward",
          .about = "Static solves of the block over one factorisation, beside CalculiX",
          .run = run_forward};
}

}  // namespace genio::bench

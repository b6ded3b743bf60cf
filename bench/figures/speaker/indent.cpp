#include "bench/figures/speaker/indent.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>

#include "speaker/indentation/simulated_data.hpp"
#include "speaker/indentation/tissue_fit.hpp"

namespace genio::bench {
namespace {

constexpr double shear_constant = 192;  // a10 [Pa]

/// Force over that of `per_modulus` times E / (1 - nu^2), one small depth.
double over_formula(const IndentationExperiment& e, double depth, double per_modulus) {
  const BlockTissue tissue{{shear_constant, 0}, {}};
  const IndentationModel m(e, depth, tissue);
  Workspace ws(m.model);
  const ForceCurve c = solve_force_curve(m, tissue, std::vector{depth}, ws);
  if (!c) throw std::runtime_error("indentation: " + c.message);
  return c.points[0].force / (per_modulus * 4 * shear_constant / (1 - e.poisson_ratio));
}

Json linear_limits(const Progress& progress) {
  const double a = 5e-3, d = 0.005 * a;
  const auto deep = [&](Indenter i) {
    return IndentationExperiment{
        .indenter = i, .radius = a, .thickness = 100 * a, .half_width = 100 * a, .mucosa = 0};
  };
  Json j;
  j["punch"] = over_formula(deep(Indenter::punch), d, 2 * a * d);
  j["pressure"] =
      over_formula(deep(Indenter::pressure), d, 3 * std::pow(std::numbers::pi, 2) / 16 * a * d);
  j["sphere"] =
      over_formula(deep(Indenter::sphere), 2 * d, 4.0 / 3 * std::sqrt(a) * std::pow(2 * d, 1.5));
  for (const auto& [name, ratio, factor] :
       {std::tuple{"layer_0.2", 0.2, 1.274}, {"layer_0.4", 0.4, 1.664}, {"layer_1", 1.0, 3.484}})
    j[name] = over_formula({.indenter = Indenter::punch,
                            .radius = a,
                            .thickness = a / ratio,
                            .half_width = 12 * a,
                            .poisson_ratio = 0.49},
                           d, 2 * a * d * factor);
  for (const auto& [name, value] : j.items())
    progress(fmt::format("{:<10} force over the formula's {:.4f}", name, value.get<double>()));
  return j;
}

struct Condition {
  const char* name;
  double young_modulus;  // [Pa]
  double mucosa;         // [m]
};

Json conditions(int repeats, unsigned seed, const Progress& progress) {
  const BlockGrid finer{4, 0.05, 1.25};
  Json rows = Json::array();
  for (const Condition& c : {Condition{"rear muscle", 1160, 0},
                             {"front muscle", 1100, 0},
                             {"rear with mucosa", 1190, 1e-3},
                             {"front with mucosa", 1140, 1e-3}}) {
    const IndentationExperiment e{.indenter = Indenter::sphere,
                                  .radius = 7e-3,
                                  .thickness = 15e-3,
                                  .half_width = 70e-3,
                                  .mucosa = c.mucosa};
    const double a10 = c.young_modulus / 6;
    const BlockTissue tissue{{a10, a10 * 90 / 192}, {384, 180}};
    ForceData data = simulated_data(e, tissue, 7e-3, 200, 0, 1, finer);
    for (int k = 0; k < repeats; ++k) {
      const ForceData measured = scattered(data, 0.05, seed + unsigned(k));
      const TissueFit fit = fit_tissue(e, measured, {.mucosa = tissue.mucosa});
      if (!fit) throw std::runtime_error(fmt::format("{}: {}", c.name, fit.message));
      const double first = fit.tissue.muscle.a10 / tissue.muscle.a10 - 1,
                   second = fit.tissue.muscle.a20 / tissue.muscle.a20 - 1;
      progress(fmt::format("{:<18} a10 {:+.2f} %, a20 {:+.2f} %, {} simulations, {:.1f} s", c.name,
                           100 * first, 100 * second, fit.simulations, fit.wall_s));
      rows.push_back({{"condition", c.name},
                      {"a10_error", first},
                      {"a20_error", second},
                      {"a10_sd", fit.constants[0].sd / tissue.muscle.a10},
                      {"a20_sd", fit.constants[1].sd / tissue.muscle.a20},
                      {"young_modulus_kPa", 1e-3 * fit.young_modulus},
                      {"forward_simulations", fit.simulations},
                      {"wall_s", fit.wall_s}});
    }
  }
  return rows;
}

Json run_indent_bench(const BenchOptions& o, const Progress& progress) {
  Json j;
  j["over_formula"] = linear_limits(progress);
  j["conditions"] = conditions(std::max(1, o.sample), o.seed, progress);
  double a10 = 0, a20 = 0;
  int simulations = 0;
  for (const Json& row : j["conditions"]) {
    a10 = std::max(a10, std::abs(row["a10_error"].get<double>()));
    a20 = std::max(a20, std::abs(row["a20_error"].get<double>()));
    simulations = std::max(simulations, row["forward_simulations"].get<int>());
  }
  j["a10_error_worst"] = a10, j["a20_error_worst"] = a20, j["simulations_most"] = simulations;
  return j;
}

}  // namespace

Benchmark indent_bench() {
  return {.name = "indent",
          .about = "Indentation: forces by the formulas, constants from curves with 5 % scatter",
          .options = {{"--sample", "curves a condition (1)"}, {"--seed", "of their scatter"}},
          .run = run_indent_bench};
}

}  // namespace genio::bench

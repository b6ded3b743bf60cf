#include "bench/figures/forward/robustness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <random>

#include "bench/problems/clock.hpp"
#include "bench/problems/densest_penetration.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/model_file.hpp"
#include "forward/statics/equilibrium.hpp"

namespace genio::bench {
namespace {

constexpr double tolerance = 1e-8;  // relative residual
constexpr double same = 1e-6;       // [m]

/// Forces of every command, each uniform up to half its maximum.
Parameters random_forces(const Model& m, std::mt19937& bits) {
  Parameters p = default_parameters(m);
  for (size_t k = 0; k < m.parameters.size(); ++k)
    if (m.parameters[k].is_command)
      p[Eigen::Index(k)] = 0.5 * m.parameters[k].info.upper * (double(bits()) / 4294967296.0);
  return p;
}

bool inverted(const Model& m, const Equilibrium& e) {
  return !std::isfinite(energy(m, e.x, e.parameters));
}

Json run_robustness(const BenchOptions& o, const Progress& progress) {
  const ModelDescription description = read_description(o.model);
  const Model m = build_model(description, o.model);
  const DensestPenetration penetration(description);
  const int count = o.sample > 0 ? o.sample : 500;
  std::mt19937 bits(2026);
  Workspace ws(m);
  SolveOptions options;
  options.tolerance = tolerance;
  int converged = 0, silent = 0, bad = 0, restarted = 0, agreed = 0;
  std::vector<double> time;
  std::map<std::string, int> reasons;
  std::map<std::string, std::vector<double>> depths;  // by bone [mm]
  Json others = Json::array();
  for (int i = 0; i < count; ++i) {
    const Parameters p = random_forces(m, bits);
    Equilibrium e;
    time.push_back(seconds([&] { e = solve_equilibrium(m, p, m.rest, ws, options); }));
    if (i % 25 == 24)
      progress(fmt::format("{} of {}: {} converged, {} of {} restarts agree, median {:.2f} s",
                           i + 1, count, converged + bool(e), agreed, restarted, median(time)));
    bad += !e.x.allFinite() || (e && inverted(m, e));
    if (!e) {
      silent += e.message.empty();
      ++reasons[e.message.substr(0, e.message.find('('))];
      continue;
    }
    ++converged;
    for (const auto& [bone, depth] : penetration(e.x)) depths[bone].push_back(1e3 * depth);
    // Again from the equilibrium of forces 10 % smaller.
    const Equilibrium near =
        solve_equilibrium(m, 0.9 * p + 0.1 * default_parameters(m), e.x, ws, options);
    if (!near) continue;
    const Equilibrium again = solve_equilibrium(m, p, near.x, ws, options);
    if (!again) continue;
    ++restarted;
    const double apart = (again.x - e.x).reshaped(3, e.x.size() / 3).colwise().norm().maxCoeff();
    if (apart < same) ++agreed;
    else
      others.push_back({{"case", i},
                        {"apart_mm", 1e3 * apart},
                        {"energies_J", {e.energy, again.energy}},
                        {"residuals", {e.residual, again.residual}}});
  }
  Json deepest;
  for (const auto& [bone, depth] : depths)
    deepest[bone] = {{"median", median(depth)},
                     {"most", *std::max_element(depth.begin(), depth.end())},
                     {"over_0.1_mm",
                      std::count_if(depth.begin(), depth.end(), [](double d) { return d > 0.1; })}};
  return {{"model", m.name},
          {"penetration_mm", deepest},
          {"cases", count},
          {"converged", converged},
          {"converged_fraction", double(converged) / count},
          {"without_reason", silent},
          {"not_finite_or_inverted", bad},
          {"reasons", reasons},
          {"restarts", restarted},
          {"restarts_agreeing", agreed},
          {"second_equilibria", others},
          {"seconds_median", median(time)},
          {"seconds_longest", *std::max_element(time.begin(), time.end())}};
}

}  // namespace

Benchmark robustness_bench() {
  return {.name = "robustness",
          .about =
              "Equilibria under random force vectors, from rest and from a neighbour; depth in the "
              "bones",
          .options = {{"--sample", "random force vectors (500)"}},
          .run = run_robustness};
}

}  // namespace genio::bench

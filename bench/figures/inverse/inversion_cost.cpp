#include "bench/figures/inverse/inversion_cost.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/problems/clock.hpp"
#include "inverse/search/multi_start.hpp"

namespace genio::bench {
namespace {

using Truth = std::vector<std::pair<const char*, double>>;

Parameters parameters(const Model& m, const Truth& forces) {
  Parameters p = default_parameters(m);
  for (const auto& [name, newtons] : forces) set_command(m, name, newtons, p);
  return p;
}

}  // namespace

Json inversion_cost(const Model& m, const Progress& progress) {
  const std::vector<Truth> truths = {{{"GGP", 2.8}, {"SL", 1.2}, {"GH", 0.9}},
                                     {{"HG", 3.0}, {"GGA", 1.0}, {"VERT", 1.5}},
                                     {{"STY", 1.5}, {"GGM", 0.8}, {"TRANS", 2.0}},
                                     {{"IL", 0.5}, {"GGP", 2.0}, {"TRANS", 1.5}}};
  Workspace ws(m);
  InferWorkspace worker(m);
  TongueState* half = worker.half(Prior{});
  TongueState& tongue = half ? *half : worker.whole();
  const double atlas_s =
      seconds([&] { tongue.atlas.get(*tongue.model, Prior{}, true, tongue.workspace); });
  std::vector<double> cold, warm, differences;
  Json cases = Json::array();
  for (const Truth& truth : truths) {
    Workspace fresh(m);
    Equilibrium e;
    const double forward =
        seconds([&] { e = solve_equilibrium(m, parameters(m, truth), m.rest, fresh); });
    if (!e) throw std::runtime_error("the bench target has no equilibrium: " + e.message);
    Target target = curve_target(m, e.x, 40, 0.5e-3);
    const Answer first = infer_from_starts(m, target, Prior{}, worker);
    // The same optimiser from the same start, once with each gradient.
    InferOptions from_rest;
    const Answer exact = infer(m, target, Prior{}, ws, from_rest);
    from_rest.finite_differences = true;
    const Answer differenced = infer(m, target, Prior{}, ws, from_rest);
    // A frame later: everything half a millimetre on.
    for (auto& p : target.curve) p.position += Vec2(0.2e-3, 0.45e-3);
    InferOptions next;
    start_from(first, next);
    const Answer second = infer_from_starts(m, target, Prior{}, worker, next, {1});
    cold.push_back(first.wall_s / forward), warm.push_back(second.wall_s / forward);
    differences.push_back(differenced.wall_s / exact.wall_s);
    cases.push_back({{"forward_s", forward},
                     {"cold_s", first.wall_s},
                     {"cold_factorizations", first.factorizations},
                     {"rms_mm", 1e3 * first.rms},
                     {"warm_s", second.wall_s},
                     {"warm_factorizations", second.factorizations},
                     {"exact_gradient_s", exact.wall_s},
                     {"finite_difference_s", differenced.wall_s},
                     {"finite_difference_status", to_string(differenced.status)},
                     {"finite_difference_rms_mm", 1e3 * differenced.rms}});
    if (progress)
      progress(
          fmt::format("forward {:.3f} s, cold {:.3f} s, warm {:.3f} s; by differences {:.2f} s",
                      forward, first.wall_s, second.wall_s, differenced.wall_s));
  }
  return {{"cold_over_forward", median(cold)},
          {"warm_over_forward", median(warm)},
          {"finite_difference_ratio", median(differences)},
          {"atlas_s", atlas_s},
          {"cases_of_cost", cases}};
}

}  // namespace genio::bench

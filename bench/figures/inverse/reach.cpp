#include "bench/figures/inverse/reach.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <random>

#include "bench/problems/clock.hpp"
#include "bench/problems/random_muscles.hpp"
#include "forward/model/build_model.hpp"
#include "forward/model/model_file.hpp"
#include "inverse/search/multi_start.hpp"

namespace genio::bench {
namespace {

constexpr int more_starts = 16;

Json run_reach(const BenchOptions& o, const Progress& progress) {
  const Model model = read_model(o.model);
  const int count = o.sample > 0 ? o.sample : 200;
  InferWorkspace ws(model);
  Workspace truth(model);
  const auto commands = muscle_unknowns(model, true);
  std::mt19937 random(416);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<double> rms, wall;
  std::map<std::string, int> verdicts;
  Json failures = Json::array(), not_explained = Json::array(), without_equilibrium = Json::array();
  int converged = 0, targets = 0;
  while (targets < count) {
    Vector z = Vector::Zero(Eigen::Index(commands.size()));
    const auto active = some_muscles(commands.size(), random, uniform);
    for (int i : active) z[i] = i == active.front() ? 1 : uniform(random);
    z *= (targets + 1.0) / count;  // from rest to where one is at its maximum
    const Equilibrium e = solve_equilibrium(
        model, apply_unknowns(commands, z, default_parameters(model)), model.rest, truth);
    if (!e) {  // no shape, no target
      without_equilibrium.push_back(e.message);
      if (int(without_equilibrium.size()) > count) break;
      continue;
    }
    ++targets;
    const Target target = curve_target(model, e.x, 40, 0.5e-3);
    const Answer a = infer_from_starts(model, target, Prior{}, ws);
    wall.push_back(a.wall_s);
    if (a.status == InferStatus::converged) {
      ++converged, ++verdicts[to_string(a.verdict)];
      rms.push_back(1e3 * a.rms);
      if (a.verdict != Verdict::explained) {
        // The shape was made by this model: more descents should find it.
        const Answer more = infer_from_starts(model, target, Prior{}, ws, {}, {more_starts});
        not_explained.push_back({{"target", targets},
                                 {"strongest_percent", 100 * z.maxCoeff()},
                                 {"verdict", to_string(a.verdict)},
                                 {"rms_mm", 1e3 * a.rms},
                                 {"chi2_per_dof", a.chi2_per_dof},
                                 {"with_more_starts", to_string(more.verdict)},
                                 {"rms_mm_with_more_starts", 1e3 * more.rms}});
      }
    } else {
      failures.push_back(fmt::format("target {}, strongest at {:.0f} %: {}", targets,
                                     100 * z.maxCoeff(), a.message));
    }
    if (progress && targets % 10 == 0)
      progress(fmt::format("{} of {}: {} converged, median RMS {:.3f} mm, {:.2f} s", targets, count,
                           converged, median(rms), median(wall)));
  }
  return {{"targets", targets},
          {"converged_fraction", double(converged) / targets},
          {"verdicts", verdicts},
          {"rms_mm_median", median(rms)},
          {"rms_mm_worst_twentieth",
           [&] {
             std::sort(rms.begin(), rms.end());
             return rms.empty() ? 0 : rms[rms.size() * 19 / 20];
           }()},
          {"wall_s_median", median(wall)},
          {"failures", failures},
          {"not_explained", not_explained},
          {"truths_without_equilibrium", without_equilibrium}};
}

}  // namespace

Benchmark reach_bench() {
  return {.name = "reach",
          .about = "Targets of the model itself, from rest to the edge of what muscles can do",
          .options = {{"--sample", "targets (200)"}},
          .run = run_reach};
}

}  // namespace genio::bench

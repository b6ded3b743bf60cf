#include "bench/figures/inverse/blind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <random>

#include "bench/problems/clock.hpp"
#include "bench/problems/random_muscles.hpp"
#include "bench/problems/truth.hpp"
#include "bench/truths/calibration_count.hpp"
#include "forward/model/build_model.hpp"
#include "inverse/search/multi_start.hpp"
#include "inverse/target/comparison.hpp"

namespace genio::bench {
namespace {

constexpr double noise = 0.5e-3;    // [m]
constexpr double fibre_turn = 5;    // [degrees]
constexpr double largest = 0.3;     // of a muscle's maximum
constexpr int points = 40;          // of the midsagittal line
constexpr double identified = 1.0;  // bits over the prior that make a muscle identified

struct Count {
  int inside = 0, of = 0;
  Json json() const { return of == 0 ? Json() : Json(double(inside) / of); }
};

}  // namespace

Json blind(const ModelDescription& description, int count, const Progress& progress) {
  const Model model = build_model(description, "model");
  const Model truth = build_model(refined(with_turned_fibres(description, fibre_turn, 2)), "truth");
  InferWorkspace ws(model);
  Workspace truth_ws(truth);
  const auto commands = muscle_unknowns(model, true);
  std::mt19937 random(2026);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::normal_distribution<double> normal;
  std::map<std::string, Count> covered, covered_active;
  Count all, converged, verdict;
  std::vector<double> rms, wall, error;
  Json failures = Json::array();
  for (int k = 0; k < count; ++k) {
    Vector z = Vector::Zero(Eigen::Index(commands.size()));
    Parameters p = default_parameters(truth);
    for (int i : some_muscles(commands.size(), random, uniform)) {
      const Unknown& c = commands[size_t(i)];
      z[i] = largest * uniform(random);
      set_command(truth, c.name, z[i] * c.scale, p);
    }
    const Equilibrium e = solve_equilibrium(truth, p, truth.rest, truth_ws);
    if (!e) {
      failures.push_back("truth: " + e.message);
      continue;
    }
    const Target clean = curve_target(truth, e.x, points, noise);
    Target target = clean;
    for (auto& q : target.curve) q.position += noise * Vec2(normal(random), normal(random));
    const Answer a = infer_from_starts(model, target, Prior{}, ws);
    ++converged.of;
    if (a.status != InferStatus::converged) {
      failures.push_back(a.message);
      continue;
    }
    ++converged.inside;
    ++verdict.of, verdict.inside += a.verdict == Verdict::explained;
    rms.push_back(Comparison(model, clean)(a.shape).rms);
    wall.push_back(a.wall_s);
    for (size_t i = 0; i < commands.size(); ++i) {
      const auto& c = a.muscles[i];
      const double force = z[Eigen::Index(i)] * c.maximum;
      const bool inside = force >= c.low - 1e-9 && force <= c.high + 1e-9;
      ++all.of, all.inside += inside;
      const std::string group = muscle_group(c.name);
      ++covered[group].of, covered[group].inside += inside;
      if (force > 0) ++covered_active[group].of, covered_active[group].inside += inside;
      if (c.information_bits > identified) error.push_back(std::abs(c.best - force) / c.maximum);
    }
    if (progress && (k + 1) % 10 == 0)
      progress(fmt::format("{} of {}: median RMS {:.2f} mm, coverage {:.1f} %, {:.2f} s", k + 1,
                           count, 1e3 * median(rms), 100.0 * all.inside / std::max(1, all.of),
                           median(wall)));
  }
  Json by_group, active_by_group;
  for (const auto& [group, c] : covered) by_group[group] = c.json();
  for (const auto& [group, c] : covered_active) active_by_group[group] = c.json();
  return {{"cases", count},
          {"converged_fraction", converged.json()},
          {"explained_fraction", verdict.json()},
          {"rms_mm_median", 1e3 * median(rms)},
          {"rms_mm_max", rms.empty() ? 0 : 1e3 * *std::max_element(rms.begin(), rms.end())},
          {"coverage90", all.json()},
          {"coverage90_by_group", by_group},
          {"coverage90_of_active_by_group", active_by_group},
          {"force_error_median", median(error)},
          {"identified_estimates", error.size()},
          {"wall_s_median", median(wall)},
          {"failures", failures}};
}

}  // namespace genio::bench

#include "bench/figures/speaker/hidden_anatomy.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>

#include "bench/problems/clock.hpp"
#include "bench/problems/random_muscles.hpp"
#include "bench/truths/calibration_count.hpp"
#include "bench/truths/erring_tongue.hpp"
#include "bench/truths/measured_shape.hpp"
#include "discrepancy/shared/shared_fit.hpp"
#include "inverse/search/multi_start.hpp"
#include "speaker/modes/mode_fields.hpp"
#include "speaker/outline/outline_facing.hpp"

namespace genio::bench {
namespace {

constexpr int postures = 8, few_cases = 8;
constexpr double posture_noise = 0.4e-3, largest_force = 0.15, within90 = 1.6449;

/// The model with the modes of these speakers.
ModelDescription with_speakers_modes(const BenchOptions& o) {
  ModelDescription base = read_description(o.model);
  std::vector<OutlinePoints> all;
  for (const std::string& speaker : outline_speakers(o.data))
    all.push_back(outline_points(facing_model(read_outline(o.data, speaker))));
  const auto fields = mode_fields(modes_of_outlines(all), base, o.model);
  return with_modes(std::move(base), fields);
}

/// One speaker and what was measured of him.
struct HiddenSpeaker {
  std::vector<double> modes;  ///< of the truth
  std::vector<std::map<std::string, double>> forces;
  Observations observations;
};

std::optional<HiddenSpeaker> drawn(const Model& known, int number, unsigned seed) {
  const ModelDescription& model = *known.description;
  std::mt19937 random(seed + 1000 * unsigned(number));
  std::uniform_real_distribution<double> uniform(0, 1);
  HiddenSpeaker s;
  s.modes.assign(model.modes.size(), 0);
  const double size = number / int(model.modes.size()) % 2 == 0 ? 1 : 2;
  s.modes[size_t(number) % s.modes.size()] = uniform(random) < 0.5 ? -size : size;
  const ModelFault fault = all_faults[size_t(number) % all_faults.size()];
  ModelDescription truth = moved(model, s.modes);  // the tongue itself, which no model knows
  truth.modes.clear(), truth.effects.erase("anatomy");
  const auto tongue = erring_tongue(truth, fault, seed + unsigned(number));
  const auto commands = muscle_unknowns(known, true);
  s.observations.noise = posture_noise;
  for (int k = 0; int(s.forces.size()) < postures && k < 2 * postures; ++k) {
    std::map<std::string, double> forces;
    for (int i : some_muscles(commands.size(), random, uniform, 2, 5))
      forces[commands[size_t(i)].name] =
          largest_force * uniform(random) * commands[size_t(i)].scale;
    const auto shape = tongue->shape(forces);
    if (!shape) continue;
    Condition c;
    c.name = fmt::format("posture {}", k + 1);
    c.target = measured_shape(tongue->whole(), *shape, all_measurements[size_t(k) % 2],
                              posture_noise, random);
    s.observations.conditions.push_back(std::move(c));
    s.forces.push_back(std::move(forces));
  }
  if (int(s.forces.size()) < postures) return std::nullopt;
  return s;
}

struct Counts {
  int held = 0, of = 0, hidden_held = 0, hidden = 0, failed = 0;
  CalibrationCount forces;
};

Json estimated(const Model& m, InferWorkspace& ws, const HiddenSpeaker& s, Counts& counts) {
  const ModelDescription& model = *m.description;
  SharedPrior shared;
  for (const AnatomyMode& mode : model.modes)
    shared.parameters[{"anatomy", mode.name}] = {{0, 1}, -3, 3};
  const SharedFit fit = fit_shared(model, s.observations, shared);
  Json modes = Json::object();
  Prior prior;
  for (size_t i = 0; i < fit.names.size(); ++i) {
    const double value = fit.values[Eigen::Index(i)];
    const double sd = std::sqrt(fit.covariance(Eigen::Index(i), Eigen::Index(i)));
    size_t k = 0;
    while (model.modes[k].name != fit.names[i].key) ++k;
    const bool held = std::abs(value - s.modes[k]) < within90 * sd;
    counts.held += held, ++counts.of;
    if (s.modes[k] != 0) counts.hidden_held += held, ++counts.hidden;
    modes[fit.names[i].key] = {{"truth", s.modes[k]}, {"value", value}, {"sd", sd}};
    prior.parameters[fit.names[i].text()] = {{value, sd}, -3, 3};
  }
  for (size_t k = 0; k < s.forces.size(); ++k) {
    const Answer a = infer_from_starts(m, s.observations.conditions[k].target, prior, ws);
    if (a.status == InferStatus::converged)
      counts.forces.add(a.muscles, s.forces[k], a.verdict, a.rms);
    else counts.forces.add_failure();
  }
  return {{"modes", modes},
          {"rms_before_mm", 1e3 * fit.rms_before},
          {"rms_after_mm", 1e3 * fit.rms_after}};
}

}  // namespace

Json hidden_anatomy_figures(const BenchOptions& o, const Progress& progress) {
  const Model model = build_model(with_speakers_modes(o), o.model);
  InferWorkspace workspace(model);
  Counts counts;
  Json rows = Json::array();
  const int count = o.sample > 0 ? o.sample : few_cases;
  for (int k = 0; k < count; ++k) {
    const auto speaker = drawn(model, k, o.seed);
    Json row;
    if (speaker) try {
        const double wall = seconds([&] { row = estimated(model, workspace, *speaker, counts); });
        row["wall_s"] = wall;
      } catch (const InputError& e) {
        row = {{"failed", e.what()}};
      }
    else row = {{"failed", "no equilibrium"}};
    counts.failed += row.contains("failed");
    progress(fmt::format("speaker {}: {}", k + 1, row.dump()));
    rows.push_back(std::move(row));
  }
  const auto share = [](int held, int of) { return of > 0 ? Json(double(held) / of) : Json(); };
  return {{"speakers", count},
          {"failed", counts.failed},
          {"modes_coverage90", share(counts.held, counts.of)},
          {"hidden_mode_coverage90", share(counts.hidden_held, counts.hidden)},
          {"forces", counts.forces.json()},
          {"each", rows}};
}

}  // namespace genio::bench

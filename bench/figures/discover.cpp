#include "bench/figures/discover.hpp"

#include <fmt/format.h>

#include <ctime>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "discrepancy/contest/discover.hpp"
#include "forward/model/build_model.hpp"

namespace genio::bench {
namespace {

namespace fs = std::filesystem;

Json found_json(const Discovery& d) {
  Json effects = Json::array(), rivals = Json::array();
  for (const NamedEffect& e : d.effects) {
    Json p = Json::object();
    for (const SharedEstimate& s : e.parameters) p[s.name.key] = {s.value, s.low, s.high};
    effects.push_back({{"effect", e.effect},
                       {"where", e.where},
                       {"confidence", e.confidence},
                       {"parameters", p}});
  }
  for (const AlternativeEffect& r : d.alternatives)
    rivals.push_back({{"effect", r.effect}, {"probability", r.probability}});
  Json rounds = Json::array();
  for (const Round& round : d.rounds) {
    Json best = Json::array();
    for (const RankedCandidate& r : round.candidates)
      if (r.refitted || best.size() < 3)
        best.push_back({{"candidate", r.candidate.label()},
                        {"score", r.score.log_evidence},
                        {"refitted", r.refitted},
                        {"log_odds", r.log_odds},
                        {"heldout_gain", r.heldout_gain},
                        {"probability", r.probability}});
    rounds.push_back(best);
  }
  const auto excess = [&](const Gap& g) { return 1e3 * g.excess; };
  return {{"verdict", to_string(d.verdict)},
          {"effects", effects},
          {"rivals", rivals},
          {"rounds", rounds},
          {"excess_before_mm", excess(d.before)},
          {"excess_after_mm", excess(d.after)},
          {"heldout_excess_before_mm", excess(d.heldout_before)},
          {"heldout_excess_after_mm", excess(d.heldout_after)},
          {"chi2_over_dof", d.rounds.front().chi_square / d.rounds.front().dof},
          {"probability_of_nothing", d.rounds.front().nothing},
          {"fit_p", d.fit_tail},
          {"heldout_p", d.heldout_tail},
          {"scoring_s", d.rounds.front().seconds_scoring},
          {"wall_s", d.seconds}};
}

std::string data_of(const std::string& folder, const HiddenCase& c) {
  return folder + "/data/" + c.name;
}

}  // namespace

std::vector<HiddenCase> discover_cases() {
  std::vector<HiddenCase> cases;
  const auto add = [&](const std::string& name, std::vector<std::string> effects, double strength,
                       bool known, unsigned seed, unsigned noise_seed) {
    HiddenCase c;
    c.effects = std::move(effects), c.strength = strength, c.forces_known = known;
    c.seed = seed, c.noise_seed = noise_seed, c.surface = noise_seed % 2 == 0;
    c.name = fmt::format("{}-{}-{}-{}", name, known ? "known" : "unknown", seed, noise_seed);
    cases.push_back(std::move(c));
  };
  for (bool known : {true, false}) {
    for (const std::string& name : hidden_names())
      for (unsigned k = 0; k < 3; ++k) {
        const bool foreign = name == "lump" || name == "tether";
        for (double strength : {1.0, 0.5})
          if (!foreign || strength == 1.0)
            add(fmt::format("{}-{}", name, strength), {name}, strength, known,
                100 * hidden_number(name) + 10 * k + (strength == 1 ? 0 : 1), k + 1);
      }
    for (unsigned truth = 0; truth < 10; ++truth)
      for (unsigned draw = 0; draw < 10; ++draw)
        add("nothing", {}, 0, known, 5000 + truth, draw + 1);
    const std::vector<std::pair<const char*, const char*>> pairs = {
        {"gravity", "stiff_region"},         {"jaw_opening", "weak_muscle"},
        {"airway_pressure", "mucosa_layer"}, {"palate_contact", "fibre_anisotropy"},
        {"extra_muscle", "gravity"},         {"hyoid_mobility", "jaw_opening"},
        {"stiff_region", "airway_pressure"}, {"weak_muscle", "gravity"},
        {"mucosa_layer", "jaw_opening"},     {"active_stiffening", "airway_pressure"}};
    for (unsigned k = 0; k < pairs.size(); ++k)
      add(fmt::format("{}+{}", pairs[k].first, pairs[k].second), {pairs[k].first, pairs[k].second},
          1, known, 7000 + k, k + 1);
  }
  return cases;
}

Json prepare_discover_case(const ModelDescription& tongue, const HiddenCase& c,
                           const std::string& folder, KnownShapes& known) {
  const std::string data = data_of(folder, c), answer = folder + "/answers/" + c.name + ".json";
  fs::create_directories(folder + "/answers");
  Json hidden;
  if (std::ifstream in(answer); in) in >> hidden;
  if (hidden.contains("failed") || (!hidden.is_null() && fs::exists(data + "/observations.toml")))
    return hidden;
  try {
    return make_hidden_data(tongue, c, data, answer, known);
  } catch (const std::exception& e) {
    return {{"case", c.name}, {"failed", e.what()}};
  }
}

Json run_discover_case(const ModelDescription& tongue, const HiddenCase& c,
                       const std::string& folder, KnownShapes& known) {
  Json result = {{"case", c.name}, {"answer", prepare_discover_case(tongue, c, folder, known)}};
  if (result["answer"].contains("failed")) return result;
  const std::string data = data_of(folder, c);
  try {
    const ModelDescription d = read_description(data + "/model");
    const Observations o =
        read_observations(data + "/observations.toml", build_model(d, data + "/model"));
    const std::clock_t started = std::clock();
    result["found"] = found_json(discover(d, o));
    result["found"]["cpu_s"] = double(std::clock() - started) / CLOCKS_PER_SEC;
  } catch (const std::exception& e) {
    result["error"] = e.what();
  }
  return result;
}

}  // namespace genio::bench

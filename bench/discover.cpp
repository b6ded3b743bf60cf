#include "discrepancy/discover.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "bench/discover_table.hpp"
#include "bench/hidden_data.hpp"

namespace genio::bench {
namespace {

namespace fs = std::filesystem;

Json found_json(const Discovery& d) {
  Json effects = Json::array(), rivals = Json::array();
  for (const NamedEffect& e : d.effects) {
    Json p = Json::object();
    for (const SharedEstimate& s : e.parameters)
      p[s.name.substr(s.name.find('.') + 1)] = {s.value, s.low, s.high};
    effects.push_back({{"effect", e.effect},
                       {"where", e.where},
                       {"confidence", e.confidence},
                       {"parameters", p}});
  }
  for (const Rival& r : d.alternatives)
    rivals.push_back({{"effect", r.effect}, {"probability", r.probability}});
  const auto excess = [&](const Gap& g) { return 1e3 * g.excess; };
  return {{"verdict", to_string(d.finding)},
          {"effects", effects},
          {"rivals", rivals},
          {"excess_before_mm", excess(d.before)},
          {"excess_after_mm", excess(d.after)},
          {"heldout_excess_before_mm", excess(d.heldout_before)},
          {"heldout_excess_after_mm", excess(d.heldout_after)},
          {"chi2_over_dof", d.rounds.front().chi_square / d.rounds.front().dof},
          {"probability_of_nothing", d.rounds.front().nothing},
          {"fit_p", d.fit_tail},
          {"scoring_s", d.rounds.front().seconds_scoring},
          {"wall_s", d.seconds}};
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
  const auto& names = hidden_names();
  for (bool known : {true, false}) {
    for (size_t i = 0; i < names.size(); ++i)
      for (unsigned k = 0; k < 3; ++k) {
        const bool foreign = names[i] == "lump" || names[i] == "tether";
        for (double strength : {1.0, 0.5})
          if (!foreign || strength == 1.0)
            add(fmt::format("{}-{}", names[i], strength), {names[i]}, strength, known,
                unsigned(100 * (i + 1) + 10 * k) + (strength == 1 ? 0 : 1), k + 1);
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

Json run_discover_case(const ModelDescription& tongue, const HiddenCase& c,
                       const std::string& folder) {
  const std::string data = folder + "/data/" + c.name,
                    answer = folder + "/answers/" + c.name + ".json";
  fs::create_directories(folder + "/answers");
  Json hidden;
  if (std::ifstream in(answer); in) in >> hidden;
  Json result = {{"case", c.name}};
  try {
    if (hidden.is_null() ||
        (!hidden.contains("failed") && !fs::exists(data + "/observations.toml")))
      hidden = make_hidden_data(tongue, c, data, answer);
    result["answer"] = hidden;
    if (hidden.contains("failed")) return result;
    const ModelDescription d = read_description(data + "/model");
    const Observations o =
        read_observations(data + "/observations.toml", build_model(d, data + "/model"));
    result["found"] = found_json(discover(d, o));
  } catch (const std::exception& e) {
    result["error"] = e.what();
    result["answer"] = {{"failed", e.what()}};
  }
  return result;
}

}  // namespace genio::bench

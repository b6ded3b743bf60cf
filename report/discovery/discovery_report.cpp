#include "report/discovery/discovery_report.hpp"

#include <nlohmann/json.hpp>

namespace genio {
namespace {

using Json = nlohmann::json;

Json effect_json(const NamedEffect& e) {
  Json parameters = Json::object(), sd = Json::object(), interval = Json::object();
  for (const SharedEstimate& p : e.parameters) {
    const std::string& key = p.name.key;
    parameters[key] = p.value, sd[key] = p.sd, interval[key] = {p.low, p.high};
  }
  return {{"name", e.effect}, {"where", e.where},       {"parameters", parameters},
          {"sd", sd},         {"interval90", interval}, {"confidence", e.confidence}};
}

Json experiments_json(const std::vector<Experiment>& all) {
  Json result = Json::array();
  for (const Experiment& e : all) {
    Json further = Json::array();
    for (const auto& [what, odds] : e.further)
      further.push_back({{"measure", what}, {"expected_log_odds", odds}});
    result.push_back({{"posture", e.label()},
                      {"forces_N", e.forces},
                      {"pitch_deg", e.pitch},
                      {"expected_log_odds", e.log_odds},
                      {"further", std::move(further)}});
  }
  return result;
}

Json triple(const Vec3& v) { return {v[0], v[1], v[2]}; }

Json where_json(const Discovery& d, const Observations& o) {
  Json patches = Json::array();
  for (const MapPatch& p : d.map_before.patches)
    patches.push_back({{"condition", o.conditions[p.condition].name},
                       {"region", p.region},
                       {"mean_mm", 1e3 * p.mean},
                       {"points", p.points}});
  return patches;
}

Json round_json(const Round& round) {
  Json candidates = Json::array();
  for (const RankedCandidate& r : round.candidates) {
    Json estimate = Json::object();
    for (size_t i = 0; i < r.candidate.strengths.size(); ++i)
      estimate[r.candidate.strengths[i].name] = r.score.estimate[Eigen::Index(i)];
    candidates.push_back({{"name", r.candidate.effect},
                          {"where", r.candidate.where},
                          {"moves", r.score.moves},
                          {"visible", r.score.visible},
                          {"statistic", r.score.statistic},
                          {"p", r.score.p},
                          {"log_evidence", r.score.log_evidence},
                          {"estimate", estimate},
                          {"detectable_of_typical", r.score.detectable},
                          {"refitted", r.refitted},
                          {"log_odds", r.log_odds},
                          {"heldout_gain", r.heldout_gain},
                          {"probability", r.probability},
                          {"message", r.message}});
  }
  return {{"candidates", candidates},
          {"probability_of_nothing", round.nothing},
          {"chi2", round.chi_square},
          {"dof", round.dof},
          {"scoring_s", round.seconds_scoring}};
}

}  // namespace

Json to_json(const Discovery& d, const Observations& o, const std::string& model) {
  Json effects = Json::array(), alternatives = Json::array(), rounds = Json::array();
  for (const NamedEffect& e : d.effects) effects.push_back(effect_json(e));
  for (const AlternativeEffect& r : d.alternatives)
    alternatives.push_back({{"name", r.effect},
                            {"where", r.where},
                            {"probability", r.probability},
                            {"similarity", r.similarity},
                            {"experiments", experiments_json(r.apart)}});
  Json families = Json::array();
  for (const ConfoundedSet& f : d.confounded_sets)
    families.push_back({{"name", f.name}, {"why", f.why}, {"members", f.members}});
  for (const Round& r : d.rounds) rounds.push_back(round_json(r));
  return {{"verdict", to_string(d.verdict)},
          {"message", d.message},
          {"effects", effects},
          {"alternatives", alternatives},
          {"families", families},
          {"gap_before_mm", 1e3 * d.before.rms},
          {"gap_after_mm", 1e3 * d.after.rms},
          {"heldout_gap_before_mm", 1e3 * d.heldout_before.rms},
          {"heldout_gap_after_mm", 1e3 * d.heldout_after.rms},
          {"noise_mm", 1e3 * d.noise},
          {"fit_p", d.fit_tail},
          {"heldout_p", d.heldout_tail},
          {"model", model.empty() ? Json() : Json(model)},
          {"where", where_json(d, o)},
          {"hidden_force",
           {{"log_evidence", d.hidden.log_evidence},
            {"total_N", d.hidden.total},
            {"centre_mm", triple(1e3 * d.hidden.centre)},
            {"resultant_N", triple(d.hidden.resultant)},
            {"region", d.hidden.region}}},
          {"rounds", rounds},
          {"wall_s", d.seconds}};
}

std::string discovery_json(const Discovery& d, const Observations& o, const std::string& model,
                           int indent) {
  return to_json(d, o, model).dump(indent);
}

}  // namespace genio

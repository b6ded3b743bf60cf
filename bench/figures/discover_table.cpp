#include "bench/figures/discover_table.hpp"

#include <algorithm>
#include <cmath>

#include "bench/problems/clock.hpp"

namespace genio::bench {
namespace {

struct Count {
  int of = 0, right = 0;
  void add(bool good) { ++of, right += good; }
  Json json() const { return of == 0 ? Json() : Json(double(right) / of); }
};

/// Those rivals that an answer takes for likely.
std::vector<std::string> likely_rivals(const Json& found) {
  std::vector<std::string> names;
  for (const Json& r : found["rivals"])
    if (r["probability"].get<double>() > 0.05) names.push_back(r["effect"]);
  return names;
}

/// Alone, or first where it says that it cannot tell it from one rival.
bool names(const Json& found, const std::string& effect) {
  const std::string verdict = found["verdict"];
  if (found["effects"].empty() || found["effects"][0]["effect"] != effect) return false;
  return verdict == "named" || (verdict == "ambiguous" && likely_rivals(found).size() <= 1);
}

/// The same, or second.
bool names_in_a_pair(const Json& found, const std::string& effect) {
  const auto rivals = likely_rivals(found);
  return names(found, effect) ||
         (found["verdict"] == "ambiguous" && rivals.size() == 1 && rivals[0] == effect);
}

bool names_anywhere(const Json& found, const std::string& effect) {
  for (size_t i = 0; i < found["effects"].size(); ++i)
    if (found["effects"][i]["effect"] == effect) return true;
  return names_in_a_pair(found, effect);
}

bool gives_a_name(const Json& found) { return !found["effects"].empty(); }

/// Of the parameters that the answer has, those that lie in their intervals.
void count_parameters(const Json& truth, const Json& found, Count& covered) {
  for (const Json& e : found["effects"]) {
    if (e["effect"] != truth["effect"]) continue;
    for (const auto& [key, value] : truth["parameters"].items()) {
      Json p;
      if (e["parameters"].contains(key)) p = e["parameters"][key];
      else continue;
      covered.add(value.get<double>() >= p[1].get<double>() - 1e-12 &&
                  value.get<double>() <= p[2].get<double>() + 1e-12);
    }
  }
}

Json figures(const std::vector<Json>& results, bool known) {
  Count strong, weak, strong_pair, weak_pair, false_alarm, foreign, two, covered;
  double gap_before = 0, gap_after = 0;  // of all
  std::vector<double> falls, seconds, scoring;
  std::map<std::string, std::map<std::string, int>> confusion;
  int out_of_reach = 0, errors = 0;
  for (const Json& r : results) {
    const Json& a = r["answer"];
    if (a.contains("failed")) {
      if (r["case"].get<std::string>().find(known ? "-known-" : "-unknown-") != std::string::npos)
        ++out_of_reach;
      continue;
    }
    if (a["forces_known"] != known) continue;
    if (r.contains("error")) {
      ++errors;
      continue;
    }
    const Json &f = r["found"], &hidden = a["hidden"];
    seconds.push_back(f["cpu_s"]), scoring.push_back(f["scoring_s"]);
    std::string truth;
    for (const Json& h : hidden)
      truth += (truth.empty() ? "" : "+") + h["effect"].get<std::string>();
    std::string said;
    for (const Json& e : f["effects"])
      said += (said.empty() ? "" : "+") + e["effect"].get<std::string>();
    const std::string verdict = f["verdict"];
    ++confusion[truth.empty() ? "nothing" : truth][said.empty() ? verdict : verdict + ": " + said];
    if (hidden.empty()) {
      false_alarm.add(gives_a_name(f));
    } else if (hidden.size() == 2) {
      two.add(names_anywhere(f, hidden[0]["effect"]) && names_anywhere(f, hidden[1]["effect"]));
    } else if (!hidden[0]["in_library"].get<bool>()) {
      foreign.add(gives_a_name(f));
    } else {
      const bool right = names(f, hidden[0]["effect"]), is_strong = a["strength"] > 0.75;
      (is_strong ? strong : weak).add(right);
      (is_strong ? strong_pair : weak_pair).add(names_in_a_pair(f, hidden[0]["effect"]));
      if (right) {
        count_parameters(hidden[0], f, covered);
        const double before = f["heldout_excess_before_mm"], after = f["heldout_excess_after_mm"];
        if (before > 0) falls.push_back(1 - after / before);
        gap_before += before, gap_after += after;
      }
    }
  }
  return {
      {"named_strength_1", strong.json()},
      {"named_strength_05", weak.json()},
      {"in_a_pair_strength_1", strong_pair.json()},
      {"in_a_pair_strength_05", weak_pair.json()},
      {"cases_strength_1", strong.of},
      {"cases_strength_05", weak.of},
      {"false_alarm", false_alarm.json()},
      {"cases_nothing", false_alarm.of},
      {"foreign_named", foreign.json()},
      {"two_named", two.json()},
      {"cases_two", two.of},
      {"heldout_gap_reduction", falls.empty() ? Json() : Json(median(falls))},
      {"heldout_gap_reduction_pooled", gap_before > 0 ? Json(1 - gap_after / gap_before) : Json()},
      {"cases_right", falls.size()},
      {"parameter_coverage90", covered.json()},
      {"seconds_per_run", seconds.empty() ? Json() : Json(median(seconds))},
      {"scoring_s", scoring.empty() ? Json() : Json(median(scoring))},
      {"out_of_reach", out_of_reach},
      {"errors", errors},
      {"confusion", confusion}};
}

Json mean_of(const Json& a, const Json& b) {
  if (a.is_null()) return b;
  if (b.is_null()) return a;
  return 0.5 * (a.get<double>() + b.get<double>());
}

}  // namespace

Json discover_figures(const std::vector<Json>& results) {
  const Json known = figures(results, true), unknown = figures(results, false);
  return {{"named_known", known["named_strength_1"]},
          {"named_unknown", unknown["named_strength_1"]},
          {"false_alarm", mean_of(known["false_alarm"], unknown["false_alarm"])},
          {"foreign_named", mean_of(known["foreign_named"], unknown["foreign_named"])},
          {"heldout_gap_reduction",
           mean_of(known["heldout_gap_reduction"], unknown["heldout_gap_reduction"])},
          {"seconds_per_run", mean_of(known["seconds_per_run"], unknown["seconds_per_run"])},
          {"forces_known", known},
          {"forces_unknown", unknown},
          {"runs", results.size()}};
}

}  // namespace genio::bench

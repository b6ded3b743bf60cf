#include "bench/figures/discover_table.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

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

/// What all runs say together, of forces known or of unknown ones.
class Tally {
 public:
  void add(const Json& answer, const Json& found);
  void add_out_of_reach() { ++out_of_reach_; }
  void add_error() { ++errors_; }
  Json json() const;

 private:
  void add_single(const Json& answer, const Json& found);

  Count strong_, weak_, strong_pair_, weak_pair_, false_alarm_, foreign_, two_, covered_;
  double gap_before_ = 0, gap_after_ = 0;  // of all
  std::vector<double> falls_, seconds_, scoring_;
  std::map<std::string, std::map<std::string, int>> confusion_;
  int out_of_reach_ = 0, errors_ = 0;
};

std::string joined_effects(const Json& all) {
  std::string joined;
  for (const Json& e : all) {
    if (!joined.empty()) joined += '+';
    joined += e["effect"].get<std::string>();
  }
  return joined;
}

void Tally::add(const Json& answer, const Json& found) {
  const Json& hidden = answer["hidden"];
  seconds_.push_back(found["cpu_s"]), scoring_.push_back(found["scoring_s"]);
  const std::string truth = joined_effects(hidden), said = joined_effects(found["effects"]);
  const std::string verdict = found["verdict"];
  ++confusion_[truth.empty() ? "nothing" : truth][said.empty() ? verdict : verdict + ": " + said];
  if (hidden.empty()) {
    false_alarm_.add(gives_a_name(found));
  } else if (hidden.size() == 2) {
    two_.add(names_anywhere(found, hidden[0]["effect"]) &&
             names_anywhere(found, hidden[1]["effect"]));
  } else if (!hidden[0]["in_library"].get<bool>()) {
    foreign_.add(gives_a_name(found));
  } else {
    add_single(answer, found);
  }
}

/// One effect of the library was hidden.
void Tally::add_single(const Json& answer, const Json& found) {
  const Json& hidden = answer["hidden"][0];
  const bool right = names(found, hidden["effect"]), is_strong = answer["strength"] > 0.75;
  (is_strong ? strong_ : weak_).add(right);
  (is_strong ? strong_pair_ : weak_pair_).add(names_in_a_pair(found, hidden["effect"]));
  if (!right) return;
  count_parameters(hidden, found, covered_);
  const double before = found["heldout_excess_before_mm"], after = found["heldout_excess_after_mm"];
  if (before > 0) falls_.push_back(1 - after / before);
  gap_before_ += before, gap_after_ += after;
}

Json Tally::json() const {
  const auto middle = [](const std::vector<double>& v) {
    return v.empty() ? Json() : Json(median(v));
  };
  return {{"named_strength_1", strong_.json()},
          {"named_strength_05", weak_.json()},
          {"in_a_pair_strength_1", strong_pair_.json()},
          {"in_a_pair_strength_05", weak_pair_.json()},
          {"cases_strength_1", strong_.of},
          {"cases_strength_05", weak_.of},
          {"false_alarm", false_alarm_.json()},
          {"cases_nothing", false_alarm_.of},
          {"foreign_named", foreign_.json()},
          {"two_named", two_.json()},
          {"cases_two", two_.of},
          {"heldout_gap_reduction", middle(falls_)},
          {"heldout_gap_reduction_pooled",
           gap_before_ > 0 ? Json(1 - gap_after_ / gap_before_) : Json()},
          {"cases_right", falls_.size()},
          {"parameter_coverage90", covered_.json()},
          {"seconds_per_run", middle(seconds_)},
          {"scoring_s", middle(scoring_)},
          {"out_of_reach", out_of_reach_},
          {"errors", errors_},
          {"confusion", confusion_}};
}

Json figures(const std::vector<Json>& results, bool known) {
  Tally tally;
  for (const Json& r : results) {
    const Json& answer = r["answer"];
    if (answer.contains("failed")) {
      if (r["case"].get<std::string>().find(known ? "-known-" : "-unknown-") != std::string::npos)
        tally.add_out_of_reach();
    } else if (answer["forces_known"] == known) {
      if (r.contains("error")) tally.add_error();
      else tally.add(answer, r["found"]);
    }
  }
  return tally.json();
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

#include "runs/results/answer_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <tuple>

#include "runs/text/json_values.hpp"
#include "runs/text/nesting.hpp"

namespace genio {
namespace {

nlohmann::json to_json(const AnswerView& v, int frame) {
  nlohmann::json j;
  j["frame"] = frame;
  j["time_s"] = std::isfinite(v.time_s) ? nlohmann::json(v.time_s) : nlohmann::json();
  j["label"] = v.label, j["recording"] = v.recording, j["speaker"] = v.speaker;
  j["status"] = v.status, j["message"] = v.message, j["verdict"] = v.verdict;
  for (const char* key :
       {"forces_N", "sd_N", "interval90_N", "activation", "information_bits", "bound_multipliers",
        "estimated", "acts", "median_N", "mean_N", "max_force_N"})
    j[key] = nlohmann::json::object();
  for (const auto& c : v.muscles) {
    j["forces_N"][c.name] = c.best;
    j["sd_N"][c.name] = c.sd;
    j["interval90_N"][c.name] = {c.low, c.high};
    j["activation"][c.name] = c.best / c.maximum;
    j["max_force_N"][c.name] = c.maximum;
    j["information_bits"][c.name] = c.information_bits;
    const std::pair<const char*, double> told[] = {
        {"acts", c.acts}, {"median_N", c.median}, {"mean_N", c.mean}};
    for (const auto& [key, value] : told)
      if (std::isfinite(value)) j[key][c.name] = value;
    if (c.multiplier > 0) j["bound_multipliers"][c.name] = c.multiplier;
  }
  for (const auto& c : v.others)
    j["estimated"][c.name] = {
        {"value", c.best}, {"unit", c.unit}, {"sd", c.sd}, {"interval90", {c.low, c.high}}};
  j["either"] = nlohmann::json::array();
  for (const JointForce& joint : v.joint)
    j["either"].push_back({{"muscles", joint.names},
                           {"acts", joint.acts},
                           {"interval90_N", {joint.low, joint.high}}});
  j["mirrored"] = v.mirrored ? nlohmann::json(*v.mirrored) : nlohmann::json();
  j["rms_mm"] = v.rms_mm, j["max_mm"] = v.max_mm, j["chi2_per_dof"] = v.chi2_per_dof;
  j["unidentified"] = v.unidentified;
  j["trade_offs"] = nlohmann::json::array();
  for (const TradeOff& trade : v.trade_offs) {
    nlohmann::json one;
    for (const Share& share : trade) one[share.name] = share.amount;
    j["trade_offs"].push_back(std::move(one));
  }
  j["weight"] = v.weight, j["mixed_optima"] = v.mixed_optima;
  j["alternatives"] = nlohmann::json::array();
  for (const Alternative& other : v.alternatives) {
    nlohmann::json one = {{"weight", other.weight}, {"rms_mm", 1e3 * other.rms}};
    for (const auto& c : other.muscles) one["forces_N"][c.name] = c.best;
    j["alternatives"].push_back(std::move(one));
  }
  j["outliers"] = v.outliers;
  j["ipopt_iterations"] = v.iterations, j["factorizations"] = v.factorizations;
  j["wall_s"] = v.wall_s;
  if (!v.registration.empty()) j["registration"] = nlohmann::json::parse(v.registration);
  return j;
}

/// The numbers among the members of an object.
std::map<std::string, double> numbers(const nlohmann::json& answer, const char* object) {
  std::map<std::string, double> result;
  if (const auto it = answer.find(object); it != answer.end() && it->is_object())
    for (const auto& [name, value] : it->items()) result[name] = number(*it, name.c_str());
  return result;
}

/// The low (0) or high (1) ends of the intervals.
std::map<std::string, double> interval_ends(const nlohmann::json& answer, size_t end) {
  std::map<std::string, double> result;
  if (const auto it = answer.find("interval90_N"); it != answer.end() && it->is_object())
    for (const auto& [name, ends] : it->items())
      if (ends.is_array() && ends.size() == 2 && ends[end].is_number())
        result[name] = ends[end].get<double>();
  return result;
}

std::map<std::string, double> estimated_values(const nlohmann::json& answer) {
  std::map<std::string, double> result;
  if (const auto it = answer.find("estimated"); it != answer.end() && it->is_object())
    for (const auto& [name, estimate] : it->items()) result[name] = number(estimate, "value");
  return result;
}

}  // namespace

std::string answer_json(const AnswerView& view, int frame, int indent) {
  // A label in an unknown encoding must not cost an answer.
  return to_json(view, frame).dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string frame_name(int frame) { return fmt::format("frame{:05d}", frame); }

bool agree(const AnswerRecord& a, const AnswerRecord& b) {
  const auto of = [](const AnswerRecord& r) {
    return std::tie(r.frame, r.status, r.verdict, r.label, r.recording, r.speaker);
  };
  if (of(a) != of(b) || a.forces_N.size() != b.forces_N.size()) return false;
  return std::all_of(a.forces_N.begin(), a.forces_N.end(), [&](const auto& force) {
    const auto other = b.forces_N.find(force.first);
    const auto sd = a.sd_N.find(force.first);
    const double near = std::max(1e-6, sd == a.sd_N.end() ? 0 : 0.1 * sd->second);
    if (other == b.forces_N.end()) return false;
    const auto one = a.activation.find(force.first), two = b.activation.find(force.first);
    const bool alike = one != a.activation.end() && two != b.activation.end() &&
                       std::abs(one->second - two->second) < 2e-3;
    return alike || !(std::abs(other->second - force.second) > near);
  });
}

std::optional<AnswerRecord> read_record(const std::string& line) {
  if (nested_too_deep(line)) return std::nullopt;
  const auto answer = nlohmann::json::parse(line, nullptr, false);
  if (!answer.is_object() || !answer.contains("frame") || !answer["frame"].is_number_integer())
    return std::nullopt;
  if (const double frame = answer["frame"].get<double>(); !(std::abs(frame) < 2e9))
    return std::nullopt;
  AnswerRecord r;
  r.frame = answer["frame"].get<int>();
  r.line = line;
  r.time_s = number(answer, "time_s");
  r.label = word(answer, "label", ""), r.recording = word(answer, "recording", "");
  r.speaker = word(answer, "speaker", "");
  r.status = word(answer, "status", "none"), r.verdict = word(answer, "verdict", "none");
  r.rms_mm = number(answer, "rms_mm"), r.max_mm = number(answer, "max_mm");
  r.chi2_per_dof = number(answer, "chi2_per_dof"), r.wall_s = number(answer, "wall_s");
  r.forces_N = numbers(answer, "forces_N"), r.sd_N = numbers(answer, "sd_N");
  r.activation = numbers(answer, "activation"), r.acts = numbers(answer, "acts");
  r.median_N = numbers(answer, "median_N"), r.max_force_N = numbers(answer, "max_force_N");
  r.low_N = interval_ends(answer, 0), r.high_N = interval_ends(answer, 1);
  r.estimated = estimated_values(answer);
  r.registration = laid_in(answer.value("registration", nlohmann::json::object()));
  return r;
}

}  // namespace genio

#include "discrepancy/contest/discovery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace genio {
namespace {

constexpr double ninety = 1.645;  // standard deviations to either end of a 90 % interval

/// How strong an effect is, in the unit of one of its strengths: of a vector its length.
double size_of(const Candidate& c, const std::string& unit,
               const std::vector<SharedEstimate>& estimates) {
  double square = 0;
  for (const FreeNumber& n : c.strengths)
    for (const SharedEstimate& e : estimates)
      if (e.name == c.effect + "." + n.name && n.info.unit == unit)
        square += std::pow(n.off(e.value), 2);
  return std::sqrt(square);
}

/// Of the model's effects only: where data were laid has nothing to do with tissue.
void widen(NamedEffect& effect, const Candidate& c, const ErrorModel& error_model) {
  if (!c.hypothesis) return;
  const std::vector<SharedEstimate> as_fitted = effect.parameters;
  const auto each = [&](const std::vector<FreeNumber>& numbers, auto doubt_of) {
    for (const FreeNumber& n : numbers)
      for (SharedEstimate& e : effect.parameters)
        if (e.name == c.effect + "." + n.name) e = widened(e, n, doubt_of(n.info));
  };
  each(c.strengths, [&](const ParameterInfo& info) {
    return error_model.efficacy_sd * size_of(c, info.unit, as_fitted);
  });
  each(c.hypothesis->details,
       [&](const ParameterInfo& info) { return info.unit == "m" ? error_model.place_sd : 0; });
}

}  // namespace

const char* to_string(DiscoveryVerdict verdict) {
  switch (verdict) {
    case DiscoveryVerdict::named:
      return "named";
    case DiscoveryVerdict::ambiguous:
      return "ambiguous";
    case DiscoveryVerdict::none:
      return "none";
    case DiscoveryVerdict::unknown:
      return "unknown";
  }
  return "none";
}

std::string message_of(DiscoveryVerdict verdict, double p, double heldout) {
  switch (verdict) {
    case DiscoveryVerdict::none:
      return fmt::format("what is left is within noise (p = {:.2g})", p);
    case DiscoveryVerdict::unknown:
      return fmt::format(
          "a gap beyond noise (p = {:.1g}, {:.1g} in conditions held out) that no candidate "
          "explains",
          p, heldout);
    case DiscoveryVerdict::ambiguous:
      return "these data do not tell the candidates below apart";
    case DiscoveryVerdict::named:
      return fmt::format("with it, what is left is within noise (p = {:.2g})", p);
  }
  return "";
}

std::vector<ConfoundedSet> confounded_sets(const Observations& o, const Round& first) {
  std::vector<ConfoundedSet> result;
  const bool some_known =
      std::any_of(o.conditions.begin(), o.conditions.end(),
                  [](const Condition& c) { return !c.heldout && c.forces.has_value(); });
  if (!some_known)
    result.push_back({"stiffness and force scale",
                      "a tongue so much stiffer under forces so much larger has the same shapes",
                      {"elasticity.a10 and a20 by one factor", "all forces by that factor"}});
  ConfoundedSet absorbed{
      "absorbed by the forces", "unknown forces make all that these would show", {}};
  for (const RankedCandidate& r : first.candidates)
    if (r.score.moves && !r.score.visible) absorbed.members.push_back(r.candidate.label());
  if (!absorbed.members.empty()) result.push_back(std::move(absorbed));
  return result;
}

Gap gap_of(const JointFit& fit, double noise) {
  Gap g;
  const Vector r = fit.residuals();
  if (r.size() == 0) return g;
  double square = 0;
  Eigen::Index at = 0;
  for (const auto& c : fit.conditions)
    for (const auto& row : c.residuals.rows) square += std::pow(r[at++] / row.scale, 2);
  g.rms = std::sqrt(square / double(r.size()));
  g.excess = std::sqrt(std::max(0.0, g.rms * g.rms - noise * noise));
  return g;
}

SharedEstimate widened(SharedEstimate e, const FreeNumber& number, double more) {
  const double strength = number.off(e.value);
  double below = std::hypot(strength - number.off(e.low), ninety * more);
  double above = std::hypot(number.off(e.high) - strength, ninety * more);
  const auto skewed = [&](double& away) {
    const double s = std::abs(strength);
    if (s > 0) away = std::max(away, s * std::expm1(std::min(1.0, away / s)));
  };
  if (number.info.absent <= number.info.lower) skewed(above);
  else if (number.info.absent >= number.info.upper) skewed(below);
  e.sd = std::hypot(e.sd, number.belief.ratio ? e.value * more : more);
  e.low = std::max(number.info.lower, number.at(strength - below));
  e.high = std::min(number.info.upper, number.at(strength + above));
  return e;
}

std::vector<NamedEffect> named(const JointFit& fit, const std::vector<Candidate>& found,
                               const std::vector<double>& confidence,
                               const ErrorModel& error_model) {
  std::vector<NamedEffect> result;
  for (size_t i = 0; i < found.size(); ++i) {
    NamedEffect n{found[i].effect, found[i].where, {}, confidence[i]};
    for (const SharedEstimate& e : fit.shared) {
      if (e.name.substr(0, e.name.find('.')) != found[i].effect) continue;
      const std::string key = e.name.substr(e.name.find('.') + 1);
      const bool other = found[i].effect == "weak_muscle" && key != found[i].where;
      if (!other) n.parameters.push_back(e);
    }
    widen(n, found[i], error_model);
    if (found[i].is_switch())
      for (const FreeNumber& s : found[i].strengths)
        n.parameters.push_back({found[i].effect + "." + s.name, s.info.unit,
                                s.info.absent + s.belief.typical, 0, 0, s.info.upper});
    result.push_back(std::move(n));
  }
  return result;
}

}  // namespace genio

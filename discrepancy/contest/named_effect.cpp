#include "discrepancy/contest/named_effect.hpp"

#include <algorithm>
#include <cmath>

#include "inverse/posterior/distributions.hpp"

namespace genio {
namespace {

constexpr double outside = 0.05;  // probability beyond either end of a 90 % interval

/// How strong an effect is, in the unit of one of its strengths: of a vector its length.
double size_of(const Candidate& c, const std::string& unit,
               const std::vector<SharedEstimate>& estimates) {
  double square = 0;
  for (const FreeNumber& n : c.strengths)
    for (const SharedEstimate& e : estimates)
      if (e.name == c.name_of(n) && n.info.unit == unit) square += std::pow(n.off(e.value), 2);
  return std::sqrt(square);
}

/// The effect with its parameters widened, if it is one of the model's: where data were laid has
/// nothing to do with tissue.
NamedEffect with_intervals(NamedEffect effect, const Candidate& c, const ErrorModel& error_model) {
  if (!c.hypothesis) return effect;
  const std::vector<SharedEstimate> as_fitted = effect.parameters;
  const auto each = [&](const std::vector<FreeNumber>& numbers, auto sd_of) {
    for (const FreeNumber& n : numbers)
      for (SharedEstimate& e : effect.parameters)
        if (e.name == c.name_of(n)) e = widened(e, n, sd_of(n.info));
  };
  each(c.strengths, [&](const ParameterInfo& info) {
    return error_model.efficacy_sd * size_of(c, info.unit, as_fitted);
  });
  each(c.hypothesis->details,
       [&](const ParameterInfo& info) { return info.unit == "m" ? error_model.place_sd : 0; });
  return effect;
}

}  // namespace

SharedEstimate widened(SharedEstimate e, const FreeNumber& number, double more) {
  const ParameterInfo& info = number.info;
  const double strength = number.off(e.value), ninety = normal_quantile(outside);
  double below = std::hypot(strength - number.off(e.low), ninety * more);
  double above = std::hypot(number.off(e.high) - strength, ninety * more);
  const auto skewed = [&](double& away) {
    const double s = std::abs(strength);
    if (s > 0) away = std::max(away, s * std::expm1(std::min(1.0, away / s)));
  };
  if (info.absent <= info.lower) skewed(above);
  else if (info.absent >= info.upper) skewed(below);
  e.sd = std::hypot(e.sd, number.belief.ratio ? e.value * more : more);
  e.low = std::max(info.lower, number.at(strength - below));
  e.high = std::min(info.upper, number.at(strength + above));
  return e;
}

std::vector<NamedEffect> named(const JointFit& fit, const std::vector<Candidate>& found,
                               const std::vector<double>& confidence,
                               const ErrorModel& error_model) {
  std::vector<NamedEffect> result;
  for (size_t i = 0; i < found.size(); ++i) {
    NamedEffect n{found[i].effect, found[i].where, {}, confidence[i]};
    for (const SharedEstimate& e : fit.shared) {
      if (e.name.effect != found[i].effect) continue;
      const bool other = found[i].effect == "weak_muscle" && e.name.key != found[i].where;
      if (!other) n.parameters.push_back(e);
    }
    n = with_intervals(std::move(n), found[i], error_model);
    if (found[i].is_switch())
      for (const FreeNumber& s : found[i].strengths)
        n.parameters.push_back({.name = found[i].name_of(s),
                                .unit = s.info.unit,
                                .value = s.info.absent + s.belief.typical,
                                .high = s.info.upper});
    result.push_back(std::move(n));
  }
  return result;
}

}  // namespace genio

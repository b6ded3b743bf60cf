#include "discrepancy/contest/model_fit.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "discrepancy/candidates/response.hpp"

namespace genio {
namespace {

constexpr double far_start = 2, near_start = 0.1;  // typical strengths
constexpr double misjudged = 1.5;                  // scale of strengths, by this factor
constexpr int most_rescales = 3;

/// Starting values of a candidate's numbers, in their own unit.
std::map<std::string, double> starts(const Candidate& c, const Score& s, double farthest) {
  std::map<std::string, double> result;
  for (size_t i = 0; i < c.strengths.size(); ++i) {
    const FreeNumber& n = c.strengths[i];
    const double least = 0.05 * n.belief.typical;  // off the kink of a one-sided one
    // A straight line may point far beyond where it holds.
    double off = std::clamp(n.off(s.estimate[Eigen::Index(i)]), -farthest * n.belief.typical,
                            farthest * n.belief.typical);
    if (std::abs(off) < least) off = n.info.absent < n.info.upper ? least : -least;
    result[c.effect + "." + n.name] = std::clamp(n.at(off), n.info.lower, n.info.upper);
  }
  return result;
}

/// What a candidate's numbers are believed to be, strong ones by `scale`, with those of `base`.
SharedPrior believed(SharedPrior base, const Candidate& c, double scale) {
  if (!c.hypothesis) {
    base.head_pose = HeadPosePrior{scale * c.strengths.front().belief.typical,
                                   scale * c.strengths.back().belief.typical};
  } else {
    const auto add = [&](const std::vector<FreeNumber>& numbers, double by) {
      for (const FreeNumber& n : numbers)
        base.parameters[c.effect + "." + n.name] = {
            {n.info.absent, by * n.belief.typical}, n.info.lower, n.info.upper, n.belief.ratio};
    };
    add(c.hypothesis->strengths, scale), add(c.hypothesis->details, 1);
  }
  base.log_weight += log_weight_of_scale(scale);
  return base;
}

/// How many times its typical strength a candidate has, at least 1.
double scale_of(const Candidate& c, const JointFit& fit) {
  double scale = 1;
  for (const FreeNumber& n : c.strengths)
    for (const SharedEstimate& e : fit.shared)
      if (e.name == c.effect + "." + n.name)
        scale = std::max(scale, std::abs(n.off(e.value)) / n.belief.typical);
  return scale;
}

std::map<std::string, double> values_of(const JointFit& fit) {
  std::map<std::string, double> result;
  for (const SharedEstimate& e : fit.shared) result[e.name] = e.value;
  return result;
}

/// Fits again while the strengths turn out to be of another scale than was believed.
void rescale(ModelFit& a, const SharedPrior& base, const Candidate& c, double scale,
             const Errors& errors, double give_up_above) {
  for (int tries = 0; tries < most_rescales && a.fit.converged; ++tries) {
    const double now = scale_of(c, a.fit);
    if (now < misjudged * scale && scale < misjudged * now) break;
    scale = now;
    a.shared = believed(base, c, scale);
    FitOptions options{&a.fit.conditions, values_of(a.fit)};
    options.give_up_above = give_up_above;
    a.fit = fit(*a.set, a.shared, &errors, options);
  }
}

/// What no such effect does and this one would; empty: nothing.
std::string implausible(const Candidate& c, const ModelFit& a) {
  const Model& m = a.set->model(0);
  for (size_t e = 0; e < m.effects.size(); ++e)
    if (m.effects[e].name() == c.effect)
      return genio::implausible(c.effect,
                                effect_parameters(m, a.fit.conditions.front().parameters, int(e)));
  return {};
}

}  // namespace

std::vector<double> log_prior(const std::vector<Candidate>& candidates) {
  std::map<std::string, int> places;
  for (const Candidate& c : candidates) ++places[c.effect];
  std::vector<double> result;
  for (const Candidate& c : candidates)
    result.push_back(-std::log(2.0 * double(places.size()) * places[c.effect]));
  return result;
}

ModelFit refit(const ModelFit& base, const Candidate& candidate, const Score& score,
               const DataErrors& evidence, double give_up_above) {
  ModelFit a;
  a.description = base.description;
  a.shared = base.shared;
  const bool is_switch = candidate.is_switch();
  if (candidate.hypothesis)
    a.description = candidate.hypothesis->added_to(std::move(a.description), is_switch);
  if (!is_switch) a.shared = believed(base.shared, candidate, score.scale);
  try {
    a.set = std::make_shared<ConditionSet>(a.description, evidence.observations,
                                           fitted_conditions(evidence.observations));
    std::vector<double> reaches{far_start, near_start};
    if (score.scale > 1) reaches.insert(reaches.begin(), far_start * score.scale);
    for (double farthest : reaches) {
      FitOptions options;
      options.shared_start = starts(candidate, score, farthest);
      // The commands start where, to first order, they answer to it.
      Vector step(score.signature.cols());
      for (size_t i = 0; i < candidate.strengths.size(); ++i) {
        const FreeNumber& n = candidate.strengths[i];
        step[Eigen::Index(i)] = n.off(options.shared_start.at(candidate.effect + "." + n.name));
      }
      const auto start = response(base.fit, evidence.fitted, score.signature * step);
      options.start = &start;
      options.give_up_above = give_up_above;
      a.fit = fit(*a.set, a.shared, &evidence.fitted, options);
      if (a.fit.u.size() > 0) break;  // else no equilibrium that far
    }
    if (!is_switch) {
      rescale(a, base.shared, candidate, score.scale, evidence.fitted, give_up_above);
    } else if (!improves(a.fit, base.fit)) {
      FitOptions anew;
      anew.give_up_above = give_up_above;
      if (JointFit f = fit(*a.set, a.shared, &evidence.fitted, anew); f.converged)
        a.fit = std::move(f);
    }
    a.message = a.fit.message;
    if (a.fit.converged) {
      if (const auto what = implausible(candidate, a); !what.empty())
        a.fit.converged = false, a.message = "it would " + what;
    }
  } catch (const InputError& e) {
    a.message = e.what();
  }
  if (a.fitted()) with_residual_test(a, evidence.fitted);
  return a;
}

bool improves(const JointFit& f, const JointFit& other) {
  return f.converged && f.value < other.value;
}

void with_residual_test(ModelFit& a, const Errors& errors) {
  const Projection projection(a.fit, errors.covariance);
  a.chi_square = projection.chi_square(), a.dof = projection.dof();
}

PosedModel posed_model_of(const ModelFit& a) {
  PosedModel e{with_fitted(a.description, a.fit), {}};
  for (const SharedEstimate& s : a.fit.shared) {
    if (s.name == "head_pose.x") e.pose.shift[0] = s.value;
    if (s.name == "head_pose.z") e.pose.shift[1] = s.value;
    if (s.name == "head_pose.turn") e.pose.turn = s.value;
  }
  return e;
}

ModelDescription with_fitted(ModelDescription d, const JointFit& fit) {
  for (const SharedEstimate& e : fit.shared) {
    const auto dot = e.name.find('.');
    const std::string effect = e.name.substr(0, dot), key = e.name.substr(dot + 1);
    if (!d.effects.contains(effect)) continue;  // the head pose
    auto& table = d.effects[effect];
    if (table.contains(key)) table[key] = e.value;
    else
      for (const char* side : {"_L", "_R"}) table[key + side] = e.value;
  }
  return d;
}

void with_heldout_fit(ModelFit& a, const std::vector<FittedCondition>* start,
                      const DataErrors& evidence) {
  const auto members = heldout_conditions(evidence.observations);
  if (members.empty()) return;
  a.heldout_set = std::make_shared<ConditionSet>(with_fitted(a.description, a.fit),
                                                 evidence.observations, members);
  // A head pose that all data were laid with is no parameter of the model, but as little free.
  SharedPrior shared;
  FitOptions options{start};
  shared.head_pose = a.shared.head_pose;
  for (const SharedEstimate& e : a.fit.shared)
    if (a.shared.head_pose && e.name.starts_with("head_pose")) options.fixed[e.name] = e.value;
  options.shared_start = options.fixed;
  a.heldout = fit(*a.heldout_set, shared, &evidence.heldout, options);
}

}  // namespace genio

#include "inverse/shape/summary.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "inverse/posterior/box_integral.hpp"
#include "inverse/shape/believed.hpp"
#include "inverse/shape/mirrored.hpp"
#include "inverse/shape/settled_posterior.hpp"

namespace genio {
namespace {

constexpr int prior_sample_count = 500;

std::string list(const std::vector<std::string>& names) {
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

LocalPosterior local_posterior(const Objective& objective, const ObjectivePoint& optimum) {
  return local_posterior(objective.prior(), optimum.activations, optimum.gradient,
                         objective.exact_hessian(optimum), objective.gauss_newton(optimum));
}

void set_estimates(const std::vector<Unknown>& unknowns, const PriorTerms& prior,
                   const ActingPosterior& posterior, const Vector& z, Answer& answer) {
  // Only of what never rests.
  const bool all_rest = (posterior.belief.slab.array() > 0).all();
  const Matrix before = all_rest ? Matrix() : sample(density_of(prior), prior_sample_count);
  const auto& [values, weights] = posterior.samples;
  std::vector<Estimate> old = std::move(answer.muscles);
  old.insert(old.end(), answer.others.begin(), answer.others.end());
  answer.muscles.clear(), answer.others.clear();
  for (Eigen::Index i = 0, f = 0; i < z.size(); ++i) {
    const Unknown& c = unknowns[size_t(i)];
    Estimate e{c.name, c.value(z[i]), c.scale, c.unit, c.kind};
    e.low = e.high = e.median = e.mean = e.best;
    const bool fixed = prior.fixed(i);
    if (!fixed) {
      const double lower = prior.lower[i], upper = prior.upper[i];
      if (posterior.belief.slab[f] > 0) {
        const ActingSummary s = summarise_acting(values.row(f), weights, upper);
        e = estimate(c, z[i], s.force, prior_sd(posterior.belief, f));
        e.acts = s.acts;
      } else {
        e = estimate(c, z[i], summarise(values.row(f), weights, lower, upper),
                     summarise(before.row(f), lower, upper).sd);
      }
      ++f;
    }
    e.fixed = fixed;
    if (size_t(i) < old.size()) {
      const Estimate& was = old[size_t(i)];
      e.at_lower = was.at_lower, e.at_upper = was.at_upper, e.multiplier = was.multiplier;
    }
    (c.kind == Unknown::Kind::muscle ? answer.muscles : answer.others).push_back(std::move(e));
  }
  answer.joint = joint_forces(posterior, unknowns);
}

void set_best_so_far(const std::vector<Unknown>& unknowns, const PriorTerms& prior,
                     const ObjectivePoint& point, Answer& answer) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  set_optimum(point, answer);
  answer.chi2_per_dof = unknown;
  answer.muscles.clear(), answer.others.clear();
  for (Eigen::Index i = 0; i < point.activations.size(); ++i) {
    const Unknown& c = unknowns[size_t(i)];
    Estimate e{c.name, c.value(point.activations[i]), c.scale, c.unit, c.kind};
    e.sd = e.low = e.high = unknown;
    e.fixed = prior.fixed(i);
    (c.kind == Unknown::Kind::muscle ? answer.muscles : answer.others).push_back(std::move(e));
  }
}

namespace {

/// Which bounds press, and how hard.
void set_bounds(const LocalPosterior& narrow, Answer& answer) {
  for (size_t f = 0; f < narrow.which.size(); ++f) {
    const auto i = size_t(narrow.which[f]), muscles = answer.muscles.size();
    Estimate& e = i < muscles ? answer.muscles[i] : answer.others[i - muscles];
    const int side = pressed(narrow.density, Eigen::Index(f));
    e.at_lower = side<0, e.at_upper = side> 0;
    if (side != 0) e.multiplier = std::abs(narrow.density.slope[Eigen::Index(f)]);
  }
}

}  // namespace

void summarise_posterior(Objective& objective, const ObjectivePoint& point,
                         const Comparison& comparison, const ModelError& error, Answer& answer) {
  const ObjectivePoint optimum = point;  // the objective forgets it at its next
  const auto& unknowns = objective.unknowns();
  const PriorTerms& prior = objective.prior();
  const Matrix rough = objective.gauss_newton(optimum);
  const Vector& z = optimum.activations;
  const LocalPosterior narrow = local_posterior(objective, optimum);
  const auto& which = narrow.which;
  ActingPosterior posterior = settled_posterior(objective, optimum, comparison, error).posterior;
  answer.mirrored = mix_mirrored(objective, optimum, posterior);
  set_estimates(unknowns, prior, posterior, z, answer);
  set_bounds(narrow, answer);
  answer.posterior = std::make_shared<ActingPosterior>(std::move(posterior));

  std::vector<std::string> at_maximum, at_zero;
  std::vector<Eigen::Index> free;
  for (Eigen::Index f = 0; f < Eigen::Index(which.size()); ++f) {
    const Unknown& c = unknowns[size_t(which[size_t(f)])];
    const int side = pressed(narrow.density, f);
    if (side == 0) free.push_back(which[size_t(f)]);
    if (c.kind == Unknown::Kind::muscle && side != 0)
      (side > 0 ? at_maximum : at_zero).push_back(c.name);
  }
  const Positions& x = optimum.equilibrium.x;
  const Matrix left =
      unabsorbed_error(optimum.residuals, error, displacement_from_rest(comparison, x),
                       ways_from_rest(optimum.residuals, x, comparison.rest()));
  std::vector<Unknown> open;
  for (auto i : which) open.push_back(unknowns[size_t(i)]);
  answer.unidentified =
      unseen_directions(optimum.jacobian(Eigen::all, which), density_of(prior).hessian, open);
  answer.log_evidence = -optimum.value + log_integral(narrow.density);

  const Matrix j_free = optimum.jacobian(Eigen::all, free);
  const double used =
      free.empty() ? 0.0
                   : (j_free * Matrix(rough(free, free)).llt().solve(j_free.transpose())).trace();
  const Vector& r = optimum.residuals.values;
  const FitTest test = test_fit(r, left + Matrix::Identity(r.size(), r.size()), used,
                                optimum.gradient.dot(rough.llt().solve(optimum.gradient)));
  answer.chi2_per_dof = test.chi2_per_dof, answer.verdict = test.verdict;
  Eigen::Index worst = 0;
  if (optimum.residuals.distances.size() > 0) optimum.residuals.distances.maxCoeff(&worst);
  const std::string where = tongue_region(comparison.line(), optimum.equilibrium.x,
                                          optimum.residuals.places[size_t(worst)]);
  answer.message =
      test.verdict == Verdict::explained
          ? double(r.size()) - used < 1
                ? fmt::format("{} values are too few to test the model", r.size())
                : fmt::format("misfit within noise (p = {:.2g})", test.tail)
          : fmt::format(
                "misfit beyond noise (p = {:.1g}), largest at the {}: {:.1f} mm; at maximum: "
                "{}; at zero: {}",
                test.tail, where, 1e3 * optimum.residuals.max, list(at_maximum), list(at_zero));
  doubt_unbelievable(unknowns, prior, z, answer);
}

}  // namespace genio

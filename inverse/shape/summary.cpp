#include "inverse/shape/summary.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "inverse/posterior/box_integral.hpp"

namespace genio {
namespace {

constexpr int sample_count = 2000;
constexpr int prior_sample_count = 1000;

std::string list(const std::vector<std::string>& names) {
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

double displacement_from_rest(const Comparison& comparison, const Positions& x) {
  const auto& nodes = comparison.line().nodes();
  double sum = 0;
  for (int a : nodes)
    sum += (node_position(x, a) - node_position(comparison.rest(), a)).squaredNorm();
  return std::sqrt(sum / double(nodes.size()));
}

LocalPosterior local_posterior(const Objective& objective, const ObjectivePoint& optimum) {
  return local_posterior(objective.prior(), optimum.activations, optimum.gradient,
                         objective.exact_hessian(optimum), objective.gauss_newton(optimum));
}

void summarise_posterior(const Objective& objective, const ObjectivePoint& optimum,
                         const Comparison& comparison, const ModelError& error, Answer& answer) {
  const auto& unknowns = objective.unknowns();
  const PriorTerms& prior = objective.prior();
  const Matrix rough = objective.gauss_newton(optimum);
  const Vector& z = optimum.activations;
  const LocalPosterior narrow = local_posterior(objective, optimum);
  const auto& which = narrow.which;
  const double displacement = displacement_from_rest(comparison, optimum.equilibrium.x);
  const auto erring = [&](double part) {
    return model_error_covariance(optimum.residuals, std::max(error.least, part * displacement),
                                  error.length);
  };
  const LocalPosterior posterior =
      widened(narrow, optimum.jacobian(Eigen::all, which), erring(error.part));
  const Matrix samples = sample(posterior.density, sample_count);
  const BoxGaussian belief = density_of(prior);
  const Matrix before = sample(belief, prior_sample_count);

  answer.muscles.clear(), answer.others.clear();
  std::vector<std::string> at_maximum, at_zero;
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0, f = 0; i < z.size(); ++i) {
    const Unknown& c = unknowns[size_t(i)];
    Estimate e{c.name, c.value(z[i]), c.scale, c.unit, c.kind};
    e.low = e.high = e.best;
    e.fixed = prior.fixed(i);
    if (!e.fixed) {
      e = estimate(c, z[i], prior.lower[i], prior.upper[i], samples.row(f), before.row(f));
      const int side = pressed(narrow.density, f);
      e.at_lower = side<0, e.at_upper = side> 0;
      if (side != 0) e.multiplier = std::abs(narrow.density.slope[f]);
      if (!e.at_lower && !e.at_upper) free.push_back(i);
      ++f;
    }
    if (c.kind == Unknown::Kind::muscle) {
      if (e.at_upper) at_maximum.push_back(c.name);
      if (e.at_lower) at_zero.push_back(c.name);
    }
    (c.kind == Unknown::Kind::muscle ? answer.muscles : answer.others).push_back(std::move(e));
  }
  std::vector<Unknown> open;
  for (auto i : which) open.push_back(unknowns[size_t(i)]);
  answer.unidentified =
      unseen_directions(optimum.jacobian(Eigen::all, which), belief.hessian, open);
  answer.log_evidence = -optimum.value + log_integral(narrow.density);

  const Matrix j_free = optimum.jacobian(Eigen::all, free);
  const double used =
      free.empty() ? 0.0
                   : (j_free * Matrix(rough(free, free)).llt().solve(j_free.transpose())).trace();
  const Vector& r = optimum.residuals.values;
  const FitTest test = test_fit(r, erring(error.left) + Matrix::Identity(r.size(), r.size()), used,
                                optimum.gradient.dot(rough.llt().solve(optimum.gradient)));
  answer.chi2_per_dof = test.chi2_per_dof, answer.verdict = test.verdict;
  Eigen::Index worst = 0;
  if (optimum.residuals.distances.size() > 0) optimum.residuals.distances.maxCoeff(&worst);
  const std::string where = tongue_region(comparison.line(), optimum.equilibrium.x,
                                          optimum.residuals.places[size_t(worst)]);
  answer.message =
      test.verdict == Verdict::explained
          ? double(r.size()) - used < 1
                ? fmt::format("the shape passes through the {} values, too few to test the model",
                              r.size())
                : fmt::format("misfit within noise (p = {:.2g})", test.tail)
          : fmt::format(
                "misfit beyond noise (p = {:.1g}), largest at the {}: {:.1f} mm; at maximum: "
                "{}; at zero: {}",
                test.tail, where, 1e3 * optimum.residuals.max, list(at_maximum), list(at_zero));
}

}  // namespace genio

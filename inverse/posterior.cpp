#include "inverse/posterior.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace genio {
namespace {

constexpr double test_level = 0.01;
constexpr int sample_count = 2000;
constexpr int prior_sample_count = 1000;

std::string list(const std::vector<std::string>& names) {
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

double way_from_rest(const Comparison& comparison, const Positions& x) {
  const auto& nodes = comparison.line().nodes();
  double sum = 0;
  for (int a : nodes)
    sum += (node_position(x, a) - node_position(comparison.rest(), a)).squaredNorm();
  return std::sqrt(sum / double(nodes.size()));
}

LocalPosterior local_posterior(const Objective& objective, const ObjectivePoint& optimum) {
  const PriorTerms& prior = objective.prior();
  LocalPosterior result{{}, prior.open()};
  const auto& which = result.which;
  const auto restricted = [&](const Matrix& h) -> Matrix { return h(which, which); };
  Matrix h = restricted(objective.exact_hessian(optimum));
  // Across a bound that presses the exact Hessian need not be definite.
  if (Eigen::LLT<Matrix>(h).info() != Eigen::Success)
    h = restricted(objective.gauss_newton(optimum));
  result.density = {optimum.activations(which), optimum.gradient(which), h, prior.lower(which),
                    prior.upper(which)};
  // What is left of the slope inside the bounds is how far the optimiser went.
  for (Eigen::Index i = 0; i < result.density.mode.size(); ++i)
    if (pressed(result.density, i) == 0) result.density.slope[i] = 0;
  return result;
}

LocalPosterior widened(const LocalPosterior& posterior, const Matrix& jacobian,
                       const Matrix& covariance) {
  LocalPosterior result = posterior;
  BoxGaussian& d = result.density;
  const Eigen::LLT<Matrix> factor(d.hessian);
  const Matrix by_data = factor.solve(jacobian.transpose());
  Matrix spread = factor.solve(Matrix::Identity(d.hessian.rows(), d.hessian.cols())) +
                  by_data * covariance * by_data.transpose();
  spread = 0.5 * (spread + spread.transpose()).eval();
  const Vector to_centre = factor.solve(d.slope);
  d.hessian = spread.llt().solve(Matrix::Identity(spread.rows(), spread.cols()));
  d.hessian = 0.5 * (d.hessian + d.hessian.transpose()).eval();
  d.slope = d.hessian * to_centre;  // the same centre
  return result;
}

MarginalSummary summarise(Vector samples, double mode, double lower, double upper) {
  std::sort(samples.begin(), samples.end());
  const Eigen::Index n = samples.size(), inside = Eigen::Index(std::ceil(0.9 * double(n)));
  Eigen::Index first = 0;
  for (Eigen::Index i = 0; i + inside <= n; ++i)
    if (samples[i + inside - 1] - samples[i] < samples[first + inside - 1] - samples[first])
      first = i;
  const double mean = samples.mean();
  MarginalSummary s{std::sqrt((samples.array() - mean).square().mean()),
                    std::min(mode, samples[first]), std::max(mode, samples[first + inside - 1])};
  // Where the density does not fall towards a bound, the interval reaches it.
  const double near = 0.05 * (s.high - s.low);
  if (s.low - lower < near) s.low = lower;
  if (upper - s.high < near) s.high = upper;
  return s;
}

std::vector<TradeOff> unseen_directions(const Matrix& jacobian, const Matrix& prior_precision,
                                        const std::vector<Command>& commands) {
  constexpr double part = 0.35;  // of a unit direction: less does not name a command
  std::vector<TradeOff> groups;
  const Matrix information = jacobian.transpose() * jacobian;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> eigen(information, prior_precision);
  for (Eigen::Index k = 0; k < information.rows(); ++k) {
    if (eigen.eigenvalues()[k] >= 1) break;  // ascending
    const Vector v = eigen.eigenvectors().col(k);
    Eigen::Index largest = 0;
    v.cwiseAbs().maxCoeff(&largest);
    TradeOff group;
    for (Eigen::Index i = 0; i < v.size(); ++i)
      if (std::abs(v[i]) > part * v.norm())
        group.push_back({commands[size_t(i)].name, v[i] / v[largest] * commands[size_t(i)].scale});
    if (!group.empty() && std::find(groups.begin(), groups.end(), group) == groups.end())
      groups.push_back(group);
  }
  return groups;
}

double chi_square_tail(double chi2, double dof) {
  const double v = 2 / (9 * dof);
  const double z = (std::cbrt(chi2 / dof) - (1 - v)) / std::sqrt(v);
  return 0.5 * std::erfc(z / std::sqrt(2.0));
}

FitTest test_fit(const Vector& r, const Matrix& scatter, double used, double gain) {
  const double dof = std::max(1.0, double(r.size()) - used);
  const double chi2 = r.dot(scatter.llt().solve(r)), tail = chi_square_tail(chi2, dof);
  const bool bounded = gain >= 0.5 * (chi2 - dof);
  return {chi2 / dof, tail,
          tail >= test_level ? Verdict::explained
          : bounded          ? Verdict::unreachable
                             : Verdict::mismatch};
}

CommandEstimate estimate(const Command& c, double mode, double lower, double upper,
                         const Vector& samples, const Vector& believed) {
  CommandEstimate e{c.name, c.value(mode), c.scale, c.unit};
  const auto s = summarise(samples, mode, lower, upper);
  const double spread = std::sqrt((believed.array() - believed.mean()).square().mean());
  e.sd = s.sd * c.slope(c.value(mode)), e.low = c.value(s.low), e.high = c.value(s.high);
  e.information_bits = std::max(0.0, std::log2(spread / std::max(1e-12, s.sd)));
  return e;
}

void summarise_posterior(const Objective& objective, const ObjectivePoint& optimum,
                         const Comparison& comparison, const ModelError& error, Answer& answer) {
  const auto& commands = objective.commands();
  const PriorTerms& prior = objective.prior();
  const Matrix rough = objective.gauss_newton(optimum);
  const Vector& z = optimum.activations;
  const LocalPosterior narrow = local_posterior(objective, optimum);
  const auto& which = narrow.which;
  const double way = way_from_rest(comparison, optimum.equilibrium.x);
  const auto erring = [&](double part) {
    return model_error_covariance(optimum.residuals, std::max(error.least, part * way),
                                  error.length);
  };
  const LocalPosterior posterior =
      widened(narrow, optimum.jacobian(Eigen::all, which), erring(error.part));
  const Matrix samples = sample(posterior.density, sample_count);
  const BoxGaussian belief = prior.density();
  const Matrix before = sample(belief, prior_sample_count);

  answer.commands.clear(), answer.along.clear();
  std::vector<std::string> at_maximum, at_zero;
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0, f = 0; i < z.size(); ++i) {
    const Command& c = commands[size_t(i)];
    CommandEstimate e{c.name, c.value(z[i]), c.scale, c.unit};
    e.low = e.high = e.force;
    e.fixed = prior.fixed(i);
    if (!e.fixed) {
      e = estimate(c, z[i], prior.lower[i], prior.upper[i], samples.row(f), before.row(f));
      const int side = pressed(narrow.density, f);
      e.at_lower = side<0, e.at_upper = side> 0;
      if (side != 0) e.multiplier = std::abs(narrow.density.slope[f]);
      if (!e.at_lower && !e.at_upper) free.push_back(i);
      ++f;
    }
    if (c.kind == Command::Kind::muscle) {
      if (e.at_upper) at_maximum.push_back(c.name);
      if (e.at_lower) at_zero.push_back(c.name);
    }
    (c.kind == Command::Kind::muscle ? answer.commands : answer.along).push_back(std::move(e));
  }
  std::vector<Command> open;
  for (auto i : which) open.push_back(commands[size_t(i)]);
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
          ? fmt::format("misfit within noise (p = {:.2g})", test.tail)
          : fmt::format(
                "misfit beyond noise (p = {:.1g}), largest at the {}: {:.1f} mm; at maximum: "
                "{}; at zero: {}",
                test.tail, where, 1e3 * optimum.residuals.max, list(at_maximum), list(at_zero));
}

}  // namespace genio

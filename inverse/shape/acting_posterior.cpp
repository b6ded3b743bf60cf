#include "inverse/shape/acting_posterior.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "inverse/posterior/posterior.hpp"

namespace genio {
namespace {

constexpr int sample_count = 4000;
constexpr double surely = 0.95;
constexpr double tells = 0.3;    // of the doubt about either one, left about both
constexpr size_t most_told = 3;  // joint statements

RestBelief rest_belief(const std::vector<Unknown>& unknowns, const PriorTerms& prior,
                       const std::vector<Eigen::Index>& which) {
  RestBelief belief;
  belief.slab = Vector::Zero(Eigen::Index(which.size()));
  for (size_t k = 0; k < which.size(); ++k) belief.slab[Eigen::Index(k)] = prior.slab[which[k]];
  belief.partner.assign(which.size(), -1);
  const auto other = other_sides(unknowns);
  for (size_t a = 0; a < which.size(); ++a)
    for (size_t b = 0; b < which.size(); ++b)
      if (other[size_t(which[a])] == which[b] && belief.slab[Eigen::Index(a)] > 0 &&
          belief.slab[Eigen::Index(b)] > 0)
        belief.partner[a] = Eigen::Index(b);
  return belief;
}

/// Data and prior about the point.
QuadraticDensity quadratic(const ObjectivePoint& p, const PriorTerms& prior,
                           const std::vector<Eigen::Index>& which, const Matrix& covariance) {
  const Matrix j = p.jacobian(Eigen::all, which);
  const Matrix weighted = covariance.llt().solve(j);
  QuadraticDensity d{prior.hessian()(which, which) + j.transpose() * weighted, {},
                     prior.lower(which), prior.upper(which)};
  d.hessian = 0.5 * (d.hessian + d.hessian.transpose()).eval();
  d.pull = d.hessian * p.activations(which) - prior.gradient(p.activations)(which) -
           weighted.transpose() * p.residuals.values;
  return d;
}

/// The density without effort where a muscle may rest, which has a slab for it.
QuadraticDensity without_effort(QuadraticDensity d, const PriorTerms& prior,
                                const std::vector<Eigen::Index>& which, const Vector& slab) {
  for (Eigen::Index i = 0; i < slab.size(); ++i)
    if (const double sd = prior.effort[which[size_t(i)]]; sd > 0 && slab[i] > 0)
      d.hessian(i, i) -= 1 / (sd * sd);
  return d;
}

/// What a newton of a muscle does is not known well: each sample's forces by a factor of median 1,
/// alike on both sides. What EMG tells is told of the force itself.
void spread_forces(const std::vector<Unknown>& unknowns, const PriorTerms& prior, double sd,
                   const ActingPosterior& posterior, Matrix& samples) {
  // Rows of the samples, those of a muscle's sides together.
  std::vector<std::vector<Eigen::Index>> muscles;
  std::map<std::string, size_t> at;
  for (size_t f = 0; f < posterior.which.size(); ++f) {
    const Eigen::Index i = posterior.which[f];
    if (prior.effort[i] == 0) continue;
    const auto [it, fresh] =
        at.try_emplace(bilateral_name(unknowns[size_t(i)].name), muscles.size());
    if (fresh) muscles.emplace_back();
    muscles[it->second].push_back(Eigen::Index(f));
  }
  std::mt19937_64 random(20260102);
  std::normal_distribution<double> normal(0, sd);
  for (Eigen::Index k = 0; k < samples.cols(); ++k)
    for (const auto& rows : muscles) {
      const double factor = std::exp(normal(random));
      for (Eigen::Index f : rows)
        samples(f, k) = std::min(prior.upper[posterior.which[size_t(f)]], factor * samples(f, k));
    }
}

}  // namespace

Matrix residual_covariance(const Residuals& r, const ModelError& error, double way) {
  Matrix covariance =
      model_error_covariance(r, std::max(error.least, error.rough * way), error.rough_length) +
      model_error_covariance(r, error.smooth * way, error.smooth_length);
  covariance.diagonal().array() += 1;
  return covariance;
}

ActingPosterior acting_posterior(QuadraticDensity whole, const std::vector<Unknown>& unknowns,
                                 const PriorTerms& prior, const ModelError& error, double way) {
  ActingPosterior result{prior.open(), {}, {}, {}};
  result.belief = rest_belief(unknowns, prior, result.which);
  const QuadraticDensity density =
      without_effort(std::move(whole), prior, result.which, result.belief.slab);
  result.samples =
      sample(density, result.belief, acting_states(density, result.belief), sample_count);
  result.centre = result.samples.values * result.samples.weights;
  spread_forces(unknowns, prior, error.efficacy_sd + error.efficacy_by_way * way, result,
                result.samples.values);
  return result;
}

ActingPosterior acting_posterior(const ObjectivePoint& point, const std::vector<Unknown>& unknowns,
                                 const PriorTerms& prior, const ModelError& error, double way) {
  return acting_posterior(
      quadratic(point, prior, prior.open(), residual_covariance(point.residuals, error, way)),
      unknowns, prior, error, way);
}

double nonlinearity(const Vector& residuals, const Matrix& jacobian, const Vector& step,
                    const Vector& there) {
  return std::sqrt((there - residuals - jacobian * step).squaredNorm() /
                   double(std::max<Eigen::Index>(1, there.size())));
}

double nonlinearity(const ObjectivePoint& here, const ObjectivePoint& there) {
  return nonlinearity(here.residuals.values, here.jacobian, there.activations - here.activations,
                      there.residuals.values);
}

std::vector<JointForce> joint_forces(const ActingPosterior& posterior,
                                     const std::vector<Unknown>& unknowns) {
  const auto& [values, weights] = posterior.samples;
  const Matrix acting = (values.array() > 0).cast<double>();
  // Of each pair the probability that both act, and of each muscle that it does.
  const Matrix both = acting * weights.asDiagonal() * acting.transpose();
  struct Pair {
    Eigen::Index first, second;
    double acts;
  };
  std::vector<Pair> pairs;
  const auto open = [&](Eigen::Index i) {
    return posterior.belief.slab[i] > 0 && both(i, i) < surely;
  };
  for (Eigen::Index a = 0; a < values.rows(); ++a)
    for (Eigen::Index b = 0; b < a; ++b)
      if (const double either = both(a, a) + both(b, b) - both(a, b);
          open(a) && open(b) && either >= surely &&
          1 - either < tells * std::min(1 - both(a, a), 1 - both(b, b)))
        pairs.push_back({b, a, either});
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.acts > b.acts; });
  if (pairs.size() > most_told) pairs.resize(most_told);
  std::vector<JointForce> told;
  for (const Pair& p : pairs) {
    const Unknown &first = unknowns[size_t(posterior.which[size_t(p.first)])],
                  &second = unknowns[size_t(posterior.which[size_t(p.second)])];
    const Vector sum = first.scale * values.row(p.first) + second.scale * values.row(p.second);
    const ActingSummary s = summarise_acting(sum, weights, first.scale + second.scale);
    told.push_back({{first.name, second.name}, p.acts, s.force.low, s.force.high});
  }
  return told;
}

}  // namespace genio

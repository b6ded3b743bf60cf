#include "inverse/posterior/posterior.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "inverse/posterior/box_integral.hpp"
#include "inverse/posterior/distributions.hpp"
#include "inverse/target/comparison.hpp"

namespace genio {
namespace {

constexpr double part_inside = 0.9;  // of an interval
constexpr double finest = 1e-3;      // standard deviation of z that counts as information
constexpr double surely = 0.05;      // probability of rest, below which a muscle surely acts

}  // namespace

LocalPosterior local_posterior(const PriorTerms& prior, const Vector& z, const Vector& gradient,
                               const Matrix& exact, const Matrix& gauss_newton) {
  LocalPosterior result{{}, prior.open()};
  const auto& which = result.which;
  Matrix h = exact(which, which);
  // Across a bound that presses the exact Hessian need not be definite.
  if (Eigen::LLT<Matrix>(h).info() != Eigen::Success) h = gauss_newton(which, which);
  result.density = {z(which), gradient(which), h, prior.lower(which), prior.upper(which)};
  // What is left of the slope inside the bounds is how far the optimiser went.
  for (Eigen::Index i = 0; i < result.density.mode.size(); ++i)
    if (pressed(result.density, i) == 0) result.density.slope[i] = 0;
  return result;
}

BoxGaussian density_of(const PriorTerms& prior) {
  const auto which = prior.open();
  const Matrix h = prior.hessian()(which, which);
  const Vector slope = prior.gradient(prior.lower)(which);  // the fixed ones are at their values
  const Vector lower = prior.lower(which), upper = prior.upper(which);
  return about(lower - h.llt().solve(slope), h, lower, upper);
}

MarginalSummary summarise(const Vector& samples, const Vector& weights, double lower,
                          double upper) {
  struct Weighted {
    double value, weight;
    bool operator<(const Weighted& other) const { return value < other.value; }
  };
  const double whole = weights.sum();
  if (!samples.allFinite() || !std::isfinite(whole))
    throw InputError(
        "the posterior has no finite samples: the standard deviations of prior and noise lie too "
        "far apart");
  std::vector<Weighted> all;
  all.reserve(size_t(samples.size()));
  for (Eigen::Index i = 0; i < samples.size(); ++i) all.push_back({samples[i], weights[i]});
  // Many samples of what may rest lie at the lower bound, and need no order.
  std::sort(
      std::partition(all.begin(), all.end(), [&](const Weighted& w) { return w.value <= lower; }),
      all.end());
  MarginalSummary s{samples.dot(weights) / whole, 0, 0, all.front().value, all.back().value};
  s.sd = std::sqrt((samples.array() - s.mean).square().matrix().dot(weights) / whole);
  double below = 0;
  for (const Weighted& w : all) {
    s.median = w.value;
    if ((below += w.weight) >= 0.5 * whole) break;
  }
  // The window from `first` on that holds enough.
  double inside = 0;
  size_t end = 0;
  for (size_t first = 0; first < all.size(); ++first) {
    while (end < all.size() && inside < part_inside * whole) inside += all[end++].weight;
    if (inside < part_inside * whole) break;
    const double low = all[first].value, high = all[end - 1].value;
    if (high - low < s.high - s.low) s.low = low, s.high = high;
    inside -= all[first].weight;
  }
  // Where the density does not fall towards a bound, the interval reaches it.
  const double near = 0.05 * (s.high - s.low);
  if (s.low - lower < near) s.low = lower;
  if (upper - s.high < near) s.high = upper;
  return s;
}

MarginalSummary summarise(const Vector& samples, double lower, double upper) {
  return summarise(samples, Vector::Ones(samples.size()), lower, upper);
}

ActingSummary summarise_acting(const Vector& samples, const Vector& weights, double upper) {
  std::vector<Eigen::Index> acting;
  for (Eigen::Index i = 0; i < samples.size(); ++i)
    if (samples[i] > 0) acting.push_back(i);
  ActingSummary result{std::min(1.0, weights(acting).sum() / weights.sum()),
                       summarise(samples, weights, 0, upper)};
  if (acting.empty()) return result;
  const MarginalSummary pull = summarise(samples(acting), weights(acting), 0, upper);
  result.force.low = 1 - result.acts > surely ? 0 : pull.low, result.force.high = pull.high;
  return result;
}

std::vector<TradeOff> unseen_directions(const Matrix& jacobian, const Matrix& prior_precision,
                                        const std::vector<Unknown>& unknowns) {
  constexpr double part = 0.35;  // of a unit direction: less does not name a command
  std::vector<TradeOff> groups;
  if (jacobian.cols() == 0) return groups;
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
        group.push_back({unknowns[size_t(i)].name, v[i] / v[largest] * unknowns[size_t(i)].scale});
    if (!group.empty() && std::find(groups.begin(), groups.end(), group) == groups.end())
      groups.push_back(group);
  }
  return groups;
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

Estimate estimate(const Unknown& c, double mode, const MarginalSummary& s, double prior_sd) {
  Estimate e{c.name, c.value(mode), c.scale, c.unit, c.kind};
  e.mean = c.value(s.mean), e.median = c.value(s.median);
  e.sd = s.sd * c.slope(c.value(mode)), e.low = c.value(s.low), e.high = c.value(s.high);
  e.information_bits = std::max(0.0, std::log2(prior_sd / std::max(finest, s.sd)));
  return e;
}

}  // namespace genio

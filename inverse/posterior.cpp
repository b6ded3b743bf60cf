#include "inverse/posterior.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace genio {
namespace {

constexpr double bound_margin = 2e-4;  // activation this near a bound sits at it
constexpr double test_level = 0.01;

/// Groups of commands that dominate a direction about which the data say less than the prior.
std::vector<std::vector<std::string>> unseen_directions(const Matrix& jacobian,
                                                        double effort_weight,
                                                        const std::vector<Command>& commands) {
  std::vector<std::vector<std::string>> groups;
  const Matrix information = jacobian.transpose() * jacobian;
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(information);
  for (Eigen::Index k = 0; k < information.rows(); ++k) {
    if (eigen.eigenvalues()[k] >= effort_weight) break;  // ascending
    const Vector v = eigen.eigenvectors().col(k);
    std::vector<std::string> group;
    for (Eigen::Index i = 0; i < v.size(); ++i)
      if (std::abs(v[i]) > 0.35) group.push_back(commands[size_t(i)].name);
    if (!group.empty() && std::find(groups.begin(), groups.end(), group) == groups.end())
      groups.push_back(group);
  }
  return groups;
}

/// Name of the tongue region at a place of the midsagittal line, by its fraction from tip to end.
std::string region(const TongueLine& line, const Positions& x, const Vec3& place) {
  const double t = line.closest(x, Vec2(place[0], place[2])).t;
  const double from_tip = (t - line.tip_parameter()) / (line.length() - line.tip_parameter());
  return from_tip < 0      ? "underside"
         : from_tip < 0.1  ? "tip"
         : from_tip < 0.3  ? "blade"
         : from_tip < 0.65 ? "dorsum"
                           : "root";
}

std::string list(const std::vector<std::string>& names) {
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

MarginalSummary summarise(const Marginal& m, bool at_lower, bool at_upper) {
  constexpr int cells = 4000;
  // Integrate where the mass is: a narrow peak would fall between points of a grid on [0, 1].
  const double width = 12 / std::max(std::sqrt(m.curvature), std::abs(m.slope));
  const double low = std::max(0.0, m.mode - width), high = std::min(1.0, m.mode + width);
  const double cell = (high - low) / cells;
  std::vector<double> cumulative(cells + 1, 0.0);
  double mean = 0, square = 0;
  for (int i = 0; i < cells; ++i) {
    const double d = low + (i + 0.5) * cell - m.mode;
    const double w = std::exp(-m.slope * d - 0.5 * m.curvature * d * d);
    cumulative[size_t(i) + 1] = cumulative[size_t(i)] + w;
    mean += w * d, square += w * d * d;
  }
  const double total = cumulative.back();
  mean /= total, square /= total;
  const auto quantile = [&](double p) {
    const auto it = std::lower_bound(cumulative.begin(), cumulative.end(), p * total);
    const auto i = std::max<std::ptrdiff_t>(1, it - cumulative.begin());
    const double part = (p * total - cumulative[size_t(i) - 1]) /
                        std::max(1e-300, cumulative[size_t(i)] - cumulative[size_t(i) - 1]);
    return low + cell * (double(i) - 1 + part);
  };
  MarginalSummary s{std::sqrt(std::max(0.0, square - mean * mean)), 0, 1};
  // Near a bound the central interval would leave the mode out; then it is one-sided as well.
  const bool from_zero = at_lower || m.mode < quantile(0.05);
  const bool to_one = at_upper || m.mode > quantile(0.95);
  s.low = from_zero ? 0.0 : quantile(to_one ? 0.1 : 0.05);
  s.high = to_one ? 1.0 : quantile(from_zero ? 0.9 : 0.95);
  return s;
}

double chi_square_tail(double chi2, double dof) {
  const double v = 2 / (9 * dof);
  const double z = (std::cbrt(chi2 / dof) - (1 - v)) / std::sqrt(v);
  return 0.5 * std::erfc(z / std::sqrt(2.0));
}

void summarise_posterior(const Objective& objective, const ObjectivePoint& optimum,
                         const Comparison& comparison, Answer& answer) {
  const auto& commands = objective.commands();
  const Matrix rough = objective.gauss_newton(optimum);
  const Vector& z = optimum.activations;
  const Eigen::Index n = z.size();
  std::vector<Eigen::Index> free;
  std::vector<bool> lower(size_t(n), false), upper(size_t(n), false);
  for (Eigen::Index i = 0; i < n; ++i) {
    lower[size_t(i)] = z[i] < bound_margin && optimum.gradient[i] > 0;
    upper[size_t(i)] = z[i] > 1 - bound_margin && optimum.gradient[i] < 0;
    if (!lower[size_t(i)] && !upper[size_t(i)]) free.push_back(i);
  }
  const Eigen::LLT<Matrix> rough_factor(Matrix(rough(free, free)));
  Eigen::LLT<Matrix> factor(Matrix(objective.hessian(optimum)(free, free)));
  if (factor.info() != Eigen::Success) factor = rough_factor;
  const Eigen::Index count = Eigen::Index(free.size());
  const Matrix covariance = factor.solve(Matrix::Identity(count, count));

  answer.commands.clear();
  std::vector<std::string> at_maximum, at_zero;
  for (Eigen::Index i = 0, f = 0; i < n; ++i) {
    const auto& command = commands[size_t(i)];
    const bool low = lower[size_t(i)], high = upper[size_t(i)];
    Marginal m{z[i], 0, 0};
    if (low || high) {
      // Gauss-Newton: across an active bound the exact Hessian may be indefinite.
      const Vector cross = rough(free, i);
      m.slope = optimum.gradient[i];
      m.curvature = rough(i, i) - (free.empty() ? 0.0 : cross.dot(rough_factor.solve(cross)));
      (high ? at_maximum : at_zero).push_back(command.name);
    } else {
      m.curvature = 1 / covariance(f, f);
      ++f;
    }
    const auto s = summarise(m, low, high);
    const double unit = command.max_force;
    answer.commands.push_back(
        {command.name, z[i] * unit, unit, s.sd * unit, s.low * unit, s.high * unit, low, high});
  }
  answer.unidentified = unseen_directions(optimum.jacobian, objective.effort_weight(), commands);

  const Matrix j_free = optimum.jacobian(Eigen::all, free);
  const double used = free.empty() ? 0.0 : (j_free * covariance * j_free.transpose()).trace();
  const double dof = std::max(1.0, double(optimum.residuals.values.size()) - used);
  const double chi2 = optimum.residuals.values.squaredNorm();
  answer.chi2_per_dof = chi2 / dof;
  const double tail = chi_square_tail(chi2, dof);
  Eigen::Index worst = 0;
  if (optimum.residuals.distances.size() > 0) optimum.residuals.distances.maxCoeff(&worst);
  const std::string where =
      region(comparison.line(), optimum.equilibrium.x, optimum.residuals.places[size_t(worst)]);
  if (tail >= test_level) {
    answer.verdict = Verdict::explained;
    answer.message = fmt::format("misfit within noise (p = {:.2g})", tail);
    return;
  }
  // What the misfit would lose if the bounds gave way.
  const double gain = optimum.gradient.dot(rough.llt().solve(optimum.gradient));
  const bool bounded = gain >= 0.5 * (chi2 - dof);
  answer.verdict = bounded ? Verdict::unreachable : Verdict::mismatch;
  answer.message = fmt::format(
      "misfit beyond noise (p = {:.1g}), largest at the {}: {:.1f} mm; at maximum: {}; at zero: {}",
      tail, where, 1e3 * optimum.residuals.max, list(at_maximum), list(at_zero));
}

}  // namespace genio

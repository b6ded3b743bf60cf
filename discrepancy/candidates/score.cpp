#include "discrepancy/candidates/score.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "forward/model/at_anatomy.hpp"
#include "forward/model/rest_derivatives.hpp"
#include "inverse/posterior/box_gaussian.hpp"
#include "inverse/posterior/distributions.hpp"
#include "inverse/target/comparison.hpp"

namespace genio {
namespace {

constexpr double invisible = 1e-3;  // whitened change at typical strength
constexpr double power = 0.9;       // of detection
constexpr double largest_scale = 64;

FreeNumber pose_number(const char* name, const char* unit, double typical) {
  return {.name = name,
          .keys = {name},
          .info = {.name = name, .unit = unit, .lower = -4 * typical, .upper = 4 * typical},
          .belief = {.parameter = name, .typical = typical}};
}

/// In which direction it may be off its absent value; 0: in either.
int side_of(const FreeNumber& n) {
  if (n.info.absent <= n.info.lower) return 1;
  return n.info.absent >= n.info.upper ? -1 : 0;
}

/// Least point of slope . s + 1/2 s . h s among those on the strengths' sides: what would be on the
/// other stays at zero while the rest is solved again.
Vector step_on_its_side(const Matrix& h, const Vector& slope,
                        const std::vector<FreeNumber>& strengths) {
  Vector step = -h.llt().solve(slope);
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < step.size(); ++i)
    if (side_of(strengths[size_t(i)]) * step[i] >= 0) free.push_back(i);
  step.setZero();
  if (!free.empty()) step(free) = -Matrix(h(free, free)).llt().solve(slope(free));
  return step;
}

struct ScaledStep {
  double scale, gain;  ///< of typical strengths; log evidence
  Vector step;         ///< of the strengths, in typical ones
  Matrix posterior;    ///< inverse of its covariance
};

/// At the scale of beliefs that gains most.
ScaledStep best_step(const Matrix& information, const Vector& slope,
                     const std::vector<FreeNumber>& strengths) {
  ScaledStep best{0, 0, {}, {}};
  const auto n = slope.size();
  for (double scale = 1; scale <= largest_scale; scale *= 2) {
    const Matrix h = information + Matrix::Identity(n, n) / (scale * scale);
    const Vector step = step_on_its_side(h, slope, strengths);
    const double gain = -slope.dot(step) - 0.5 * step.dot(h * step) -
                        0.5 * std::log(h.determinant()) - double(n) * std::log(scale) +
                        log_weight_of_scale(scale);
    if (best.scale == 0 || gain > best.gain) best = {scale, gain, step, h};
  }
  return best;
}

/// dF / d strength as nodal forces [N per unit].
Forces forces_by(const Hypothesis& h, const FreeNumber& strength, const Model& model,
                 const FittedCondition& c) {
  Forces df = Forces::Zero(c.x.size());
  if (h.made.modes) {
    for (const std::string& key : strength.keys) {
      const int k[] = {mode_named(model, key)};
      df += force_by_modes(model, c.x, c.parameters, k).col(0);
    }
    return df;
  }
  if (find_effect(model, h.effect)) {  // others may read its parameters too: a jaw that touches
    for (const std::string& key : strength.keys) {
      const int k[] = {parameter_index(model, ParameterName{h.effect, key})};
      df += force_derivatives(model, c.x, c.parameters, k).col(0);
    }
    return df;
  }
  if (!h.made.potential) return df;  // no force in statics
  const Potential& potential = *h.made.potential;
  const auto info = potential.parameters();
  std::vector<double> values;
  for (const ParameterInfo& i : info) values.push_back(i.value);
  for (const ParameterName& name : potential.borrows())
    values.push_back(c.parameters[parameter_index(model, name)]);
  for (const std::string& key : strength.keys)
    for (size_t i = 0; i < info.size(); ++i)
      if (info[i].name == key) potential.add_force_derivative(c.x, values, int(i), df);
  return df;
}

/// What the residuals see of nodes that go with a bone, besides the forces.
Vector seen_of_bones(const Hypothesis& h, const FreeNumber& strength, const Model& model,
                     const FittedCondition& c) {
  Vector held = Vector::Zero(c.x.size());
  if (h.made.modes)
    for (const std::string& key : strength.keys)
      held += held_by_mode(model, mode_named(model, key));
  return residual_jacobian(c.residuals, held);
}

}  // namespace

std::vector<Candidate> candidates(const ModelDescription& description,
                                  const Observations& observations) {
  std::vector<Candidate> result;
  for (Hypothesis& h : hypotheses(description)) {
    Candidate c{h.effect, h.where, {}, h.strengths};
    c.hypothesis = std::move(h);
    result.push_back(std::move(c));
  }
  if (!observations.head_pose)
    result.push_back({"head_pose",
                      "",
                      {},
                      {pose_number("x", "m", 1e-3), pose_number("z", "m", 1e-3),
                       pose_number("turn", "rad", 0.02)}});
  return result;
}

double log_weight_of_scale(double scale) { return -std::log(scale); }

Projection::Projection(const JointFit& f, const Eigen::LLT<Matrix>& covariance)
    : covariance_(covariance) {
  const Vector r = covariance_.matrixL().solve(f.residuals());
  const Vector prior = f.prior_rows * f.u - f.prior_values;
  residuals_.resize(r.size() + prior.size());
  residuals_ << r, prior;
  const Matrix j = covariance_.matrixL().solve(f.jacobian());
  Matrix all(residuals_.size(), f.u.size());
  all << j, f.prior_rows;
  const Vector slope = all.transpose() * residuals_;
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < f.u.size(); ++i) {
    if (f.lower[i] == f.upper[i]) continue;
    if (f.u[i] < f.lower[i] + at_bound && slope[i] > 0) continue;
    if (f.u[i] > f.upper[i] - at_bound && slope[i] < 0) continue;
    free.push_back(i);
  }
  const Matrix tangent = all(Eigen::all, free);
  if (!free.empty()) {
    const Eigen::LLT<Matrix> h(tangent.transpose() * tangent);
    basis_ = h.matrixL().solve(tangent.transpose()).transpose();
  } else {
    basis_ = Matrix::Zero(residuals_.size(), 0);
  }
  chi_square_ = r.squaredNorm();
  dof_ = double(r.size()) - basis_.topRows(r.size()).squaredNorm();
}

Matrix Projection::operator()(const Matrix& columns) const {
  Matrix all = Matrix::Zero(residuals_.size(), columns.cols());
  all.topRows(columns.rows()) = covariance_.matrixL().solve(columns);
  return all - basis_ * (basis_.transpose() * all);
}

Matrix signature(const Candidate& candidate, const ConditionSet& set, const JointFit& fit,
                 const std::vector<Matrix>& influences) {
  Eigen::Index rows = 0;
  for (const Matrix& a : influences) rows += a.rows();
  const auto count = Eigen::Index(candidate.strengths.size());
  Matrix result(rows, count);
  rows = 0;
  for (size_t k = 0; k < influences.size(); ++k) {
    const FittedCondition& c = fit.conditions[k];
    auto block = result.middleRows(rows, influences[k].rows());
    rows += influences[k].rows();
    if (!candidate.hypothesis) {
      block = c.residuals.pose;
      continue;
    }
    for (Eigen::Index s = 0; s < count; ++s)
      block.col(s) =
          influences[k] *
              forces_by(*candidate.hypothesis, candidate.strengths[size_t(s)], set.model(k), c) +
          seen_of_bones(*candidate.hypothesis, candidate.strengths[size_t(s)], set.model(k), c);
  }
  return result;
}

std::vector<Score> score(const std::vector<Candidate>& candidates, const ConditionSet& set,
                         const JointFit& fit, const std::vector<Matrix>& influences,
                         const Projection& projection, double level) {
  std::vector<Score> result;
  for (size_t c = 0; c < candidates.size(); ++c) {
    const auto& strengths = candidates[c].strengths;
    const auto count = Eigen::Index(strengths.size());
    Score s;
    s.candidate = c;
    Vector typical(count);
    for (Eigen::Index i = 0; i < count; ++i) typical[i] = strengths[size_t(i)].belief.typical;
    // By one typical strength.
    s.signature = signature(candidates[c], set, fit, influences);
    const Matrix change = s.signature * typical.asDiagonal();
    s.moves = change.squaredNorm() > invisible * invisible;
    const Matrix g = projection(change);
    s.estimate = Vector::Zero(count), s.sd = Vector::Zero(count);
    // Directions that the data do not see are left to what is believed.
    const Matrix information = g.transpose() * g;
    s.visible = information.trace() > invisible * invisible;
    if (s.visible) {
      const Vector slope = g.transpose() * projection.residuals();
      const auto [scale, gain, step, posterior] = best_step(information, slope, strengths);
      s.scale = scale, s.log_evidence = gain;
      const Eigen::JacobiSVD<Matrix> svd(information, Eigen::ComputeThinU);
      double chi2 = 0;
      int dof = 0;
      for (Eigen::Index i = 0; i < count; ++i)
        if (const double v = svd.singularValues()[i]; v > invisible * invisible)
          chi2 += std::pow(svd.matrixU().col(i).dot(slope), 2) / v, ++dof;
      const int side = count == 1 ? side_of(strengths[0]) : 0;
      if (side != 0) {
        const double z = -side * slope[0] / std::sqrt(information(0, 0));
        s.statistic = std::pow(std::max(0.0, z), 2);
        s.p = normal_tail(z);
      } else {
        s.statistic = chi2;
        s.p = dof == 1 ? 2 * normal_tail(std::sqrt(chi2)) : chi_square_tail(chi2, dof);
      }
      // A switch has no strength to pay for, and its typical one is a penalty's.
      if (candidates[c].is_switch()) s.log_evidence = 0.5 * s.statistic;
      const Vector sd = posterior.inverse().diagonal().cwiseSqrt();
      for (Eigen::Index i = 0; i < count; ++i) {
        const FreeNumber& n = strengths[size_t(i)];
        s.estimate[i] = n.at(step[i] * typical[i]);
        s.sd[i] =
            0.5 * (n.at((step[i] + sd[i]) * typical[i]) - n.at((step[i] - sd[i]) * typical[i]));
      }
      s.direction = g * (step.isZero(0) ? Vector(Vector::Ones(count)) : step);
      s.direction.normalize();
      const double sides = side != 0 ? 1 : 2;
      const double z =
          normal_quantile(level / sides / double(candidates.size())) + normal_quantile(1 - power);
      s.detectable = z / std::sqrt(information.trace() / double(count));
    }
    result.push_back(std::move(s));
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const Score& a, const Score& b) { return a.log_evidence > b.log_evidence; });
  return result;
}

}  // namespace genio

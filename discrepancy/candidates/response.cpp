#include "discrepancy/candidates/response.hpp"

#include <algorithm>

#include "inverse/posterior/box_gaussian.hpp"

namespace genio {

std::vector<FittedCondition> response(const JointFit& f, const Errors& errors,
                                      const Vector& change) {
  const auto whitened = [&](const Matrix& m) {
    return errors.covariance.matrixL().solve(m).eval();
  };
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < f.own; ++i)
    if (f.u[i] > f.lower[i] + at_bound && f.u[i] < f.upper[i] - at_bound) free.push_back(i);
  std::vector<FittedCondition> moved = f.conditions;
  if (free.empty()) return moved;
  const Matrix j = whitened(f.jacobian()(Eigen::all, free)), a = f.prior_rows(Eigen::all, free);
  const Vector slope = j.transpose() * whitened(change);
  Vector u = f.u;
  u(free) -= Matrix(j.transpose() * j + a.transpose() * a).llt().solve(slope);
  u = u.cwiseMax(f.lower).cwiseMin(f.upper);
  for (FittedCondition& c : moved) c.z = u(c.which);
  return moved;
}

std::vector<FittedCondition> with_candidate(const Candidate& candidate,
                                            const std::vector<SharedEstimate>& estimates,
                                            const ConditionSet& set, const JointFit& f,
                                            const Errors& errors,
                                            const std::vector<Matrix>& influences) {
  Vector step = Vector::Zero(Eigen::Index(candidate.strengths.size()));
  for (size_t i = 0; i < candidate.strengths.size(); ++i)
    for (const SharedEstimate& e : estimates)
      if (e.name == candidate.name_of(candidate.strengths[i]))
        step[Eigen::Index(i)] = candidate.strengths[i].off(e.value);
  return response(f, errors, signature(candidate, set, f, influences) * step);
}

std::vector<FittedCondition> without_candidate(const Candidate& candidate, const JointFit& f,
                                               const Errors& errors) {
  const FittedCondition& first = f.conditions.front();
  Vector step = Vector::Zero(f.u.size());
  for (const FreeNumber& n : candidate.strengths)
    for (size_t i = 0; i < first.unknowns.size(); ++i)
      if (first.unknowns[i].parameter == candidate.name_of(n))
        step[first.which[i]] = first.unknowns[i].z_of(n.info.absent) - first.z[Eigen::Index(i)];
  return response(f, errors, f.jacobian() * step);
}

}  // namespace genio

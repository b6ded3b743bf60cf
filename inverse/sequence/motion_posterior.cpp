#include "inverse/sequence/motion_posterior.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "inverse/posterior/box_gaussian.hpp"
#include "inverse/shape/settled_posterior.hpp"

namespace genio {
namespace {

/// A motion to first order about its unknowns, and minus its log posterior to second order.
struct MotionExpansion {
  Vector u, residuals;
  Matrix jacobian, hessian;
  Vector gradient;
  std::vector<double> way;  ///< of the line from rest at each knot [m]
};

std::optional<MotionExpansion> expansion(MotionProblem& problem, const Vector& u,
                                         const ModelError& error) {
  const auto local = problem.local_problem(u);
  // Another point may have been looked at since.
  if (!local || !problem.value(u)) return {};
  const QuadraticTerm& prior = problem.prior();
  MotionExpansion e{u,
                    problem.values(),
                    local->jacobian(u),
                    Matrix(Eigen::SparseMatrix<double>(prior.rows.transpose() * prior.rows)),
                    prior.gradient(u),
                    {}};
  Eigen::Index first = 0;
  for (size_t k = 0; k < problem.comparisons().size(); ++k) {
    const Residuals& r = problem.residuals()[k];
    const auto rows = Eigen::seqN(first, r.values.size());
    const Matrix j = e.jacobian(rows, Eigen::all);
    const double way = displacement_from_rest(problem.comparisons()[k], problem.shape(k));
    const Matrix weighted = residual_covariance(r, error, way).llt().solve(j);
    e.hessian += j.transpose() * weighted;
    e.gradient += weighted.transpose() * r.values;
    first += r.values.size();
  }
  for (double t : problem.controls().knots)
    e.way.push_back(
        displacement_from_rest(problem.comparisons().front(), shape_at(problem.trajectory(), t)));
  return e;
}

/// Of one knot, the others marginalised.
ActingPosterior at_knot(const MotionProblem& problem, const MotionExpansion& e, size_t knot,
                        const ModelError& error) {
  const auto n = Eigen::Index(problem.unknowns().size());
  const PriorTerms terms = terms_at(problem, knot);
  const auto which = terms.open();
  std::vector<Eigen::Index> own, others;
  for (Eigen::Index i : which) own.push_back(n * Eigen::Index(knot) + i);
  for (Eigen::Index i = 0; i < e.u.size(); ++i)
    if (i / n != Eigen::Index(knot) && e.u[i] > problem.lower()[i] + at_bound &&
        e.u[i] < problem.upper()[i] - at_bound)
      others.push_back(i);
  QuadraticDensity density{e.hessian(own, own), {}, terms.lower(which), terms.upper(which)};
  Vector gradient = e.gradient(own);
  if (!others.empty()) {
    const Matrix across = e.hessian(others, own);
    const Matrix through = Matrix(e.hessian(others, others)).llt().solve(across);
    density.hessian -= across.transpose() * through;
    gradient -= through.transpose() * e.gradient(others);
  }
  density.hessian = 0.5 * (density.hessian + density.hessian.transpose()).eval();
  density.pull = density.hessian * e.u(own) - gradient;
  return acting_posterior(std::move(density), problem.unknowns(), terms, error, e.way[knot]);
}

std::vector<ActingPosterior> at_knots(const MotionProblem& problem, const MotionExpansion& e,
                                      const ModelError& error) {
  std::vector<ActingPosterior> result;
  for (size_t knot = 0; knot < e.way.size(); ++knot)
    result.push_back(at_knot(problem, e, knot, error));
  return result;
}

Vector mean_of(const std::vector<ActingPosterior>& knots, Vector u) {
  const auto n = u.size() / Eigen::Index(knots.size());
  for (size_t knot = 0; knot < knots.size(); ++knot)
    for (size_t f = 0; f < knots[knot].which.size(); ++f)
      u[n * Eigen::Index(knot) + knots[knot].which[f]] = knots[knot].centre[Eigen::Index(f)];
  return u;
}

}  // namespace

PriorTerms terms_at(const MotionProblem& problem, size_t knot) {
  PriorTerms terms = problem.terms();
  const auto n = Eigen::Index(problem.unknowns().size());
  terms.lower = problem.lower().segment(n * Eigen::Index(knot), n);
  terms.upper = problem.upper().segment(n * Eigen::Index(knot), n);
  return terms;
}

std::vector<ActingPosterior> motion_posterior(MotionProblem& problem, const Vector& u,
                                              const ModelError& error) {
  const auto here = expansion(problem, u, error);
  if (!here) return {};
  std::vector<ActingPosterior> result = at_knots(problem, *here, error);
  const Vector mean = mean_of(result, here->u);
  if (!problem.value(mean) ||
      nonlinearity(here->residuals, here->jacobian, mean - here->u, problem.values()) < straight)
    return result;
  // Once: a derivative costs as much as several motions.
  if (const auto there = expansion(problem, mean, error)) result = at_knots(problem, *there, error);
  return result;
}

}  // namespace genio

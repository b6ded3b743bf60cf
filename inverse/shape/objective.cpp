#include "inverse/shape/objective.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <numeric>

#include "forward/statics/sensitivity.hpp"
#include "inverse/shape/curvature.hpp"
#include "inverse/target/comparison.hpp"

namespace genio {
namespace {

constexpr double trial_tolerance = 1e-8;
constexpr int trial_factorizations = 10;
constexpr double longest_guess = 2e-3;  // of any node [m]
constexpr double small_gain = 0.1;      // of the objective
constexpr double near_bound = 2e-3;     // activation

bool same(const Vector& a, const Vector& b) {
  return a.size() == b.size() && (a - b).cwiseAbs().maxCoeff() < 1e-12;
}

}  // namespace

Objective::Objective(const Model& model, const Comparison& comparison, const Prior& prior,
                     const InferOptions& options, Workspace& ws)
    : model_(model),
      comparison_(comparison),
      options_(options),
      ws_(ws),
      unknowns_(
          unknowns_of(model, prior, options.bilateral.value_or(comparison.target().midsagittal()))),
      base_(default_parameters(model)),
      prior_(prior_terms(prior, unknowns_)),
      clock_(options),
      factorizations_before_(ws.cholesky.factorizations()) {}

void Objective::weigh(ObjectivePoint& p) const {
  p.value = 0.5 * p.residuals.values.squaredNorm() + prior_.value(p.activations);
  if (p.positions.size() > 0)
    p.gradient = p.jacobian.transpose() * p.residuals.values + prior_.gradient(p.activations);
}

void Objective::set_prior(PriorTerms prior) {
  prior_ = std::move(prior);
  if (have_last_) weigh(last_);
  if (have_anchor_) weigh(anchor_);
}

bool Objective::known_start(const Vector& activations, ObjectivePoint& point) const {
  if (!options_.start_shape || !same(activations, options_.start) ||
      options_.start_by_unknown.cols() != activations.size())
    return false;
  point.equilibrium.status = SolveStatus::converged;
  point.equilibrium.x = *options_.start_shape;
  point.equilibrium.parameters = apply_unknowns(unknowns_, activations, base_);
  return true;
}

bool Objective::solve(const Vector& activations, ObjectivePoint& point) {
  if (stopped()) return false;
  point.activations = activations;
  if (!known_start(activations, point)) {
    const Parameters p = apply_unknowns(unknowns_, activations, base_);
    Positions start = model_.rest;
    SolveOptions solve_options;
    if (have_anchor_) {
      // Over a long way a straight guess is worse than the solver's own path. A step into inverted
      // tissue is refused, which costs nothing; a shorter one follows.
      start = anchor_.equilibrium.x;
      const Vector way = anchor_.positions * (activations - anchor_.activations);
      if (way.cwiseAbs().maxCoeff() < longest_guess) start = ws_.curved(start, way);
      if (!std::isfinite(energy(model_, start, p))) {
        failure_ = "the step is too long to follow";
        return false;
      }
      solve_options.tolerance = trial_tolerance;
      solve_options.max_factorizations = trial_factorizations;
      solve_options.max_load_steps = 0;
    } else if (have_last_) {
      start = last_.equilibrium.x;
    } else if (options_.start_shape) {
      start = *options_.start_shape;
      if (options_.start_factorizations > 0) {
        solve_options.max_factorizations = options_.start_factorizations;
        solve_options.max_load_steps = 0;
      }
    }
    ++forward_solves_;
    point.equilibrium = solve_equilibrium(model_, p, start, ws_, solve_options);
    if (!point.equilibrium) {
      failure_ = point.equilibrium.message;
      return false;
    }
  }
  point.residuals = comparison_(point.equilibrium.x, head_pose(unknowns_, activations));
  weigh(point);
  return true;
}

const ObjectivePoint* Objective::at(const Vector& activations) {
  if (have_last_ && same(last_.activations, activations)) return &last_;
  if (have_anchor_ && same(anchor_.activations, activations)) return &anchor_;
  ObjectivePoint point;
  if (!solve(activations, point)) return nullptr;
  last_ = std::move(point);
  have_last_ = true;
  return &last_;
}

std::optional<double> Objective::value(const Vector& activations) {
  const auto* p = at(activations);
  return p ? std::optional(p->value) : std::nullopt;
}

void Objective::set_positions(ObjectivePoint& point, Matrix positions) const {
  point.positions = std::move(positions);
  point.jacobian = residual_jacobian(point.residuals, point.positions) +
                   point.residuals.pose * pose_derivative(unknowns_);
  weigh(point);
}

const ObjectivePoint* Objective::keep(ObjectivePoint point) {
  anchor_ = std::move(point);
  have_anchor_ = true;
  return &anchor_;
}

const ObjectivePoint* Objective::derivatives(const Vector& activations) {
  if (have_anchor_ && same(anchor_.activations, activations) && anchor_.adjoint.size() > 0)
    return &anchor_;
  const auto* here = at(activations);
  if (!here) return nullptr;
  ObjectivePoint point = *here;
  const Positions& x = point.equilibrium.x;
  const auto n = Eigen::Index(unknowns_.size());
  Matrix right(x.size(), n + 1);
  right << force_by_unknown(model_, unknowns_, x, point.equilibrium.parameters),
      misfit_gradient(point.residuals, x.size());
  Matrix solved = sensitivity_to_forces(model_, point.equilibrium, right, ws_);
  if (solved.size() == 0) {
    failure_ = "the equilibrium is unstable";
    return nullptr;
  }
  point.adjoint = solved.col(n);
  solved.leftCols(n) += held_by_unknown(model_, unknowns_, point.equilibrium.parameters);
  set_positions(point, solved.leftCols(n));
  return keep(std::move(point));
}

std::optional<LocalShape> Objective::local_shape(const Vector& activations, int first) {
  const ObjectivePoint* point = nullptr;
  ObjectivePoint start;
  if (!have_anchor_ && known_start(activations, start)) {
    const auto* here = at(activations);
    if (!here) return {};
    start = *here;
    set_positions(start, options_.start_by_unknown);
    point = keep(std::move(start));
  } else {
    point = derivatives(activations);
  }
  if (!point) return {};
  std::vector<int> which(unknowns_.size());
  std::iota(which.begin(), which.end(), first);
  LocalShape shape(comparison_, point->equilibrium.x, point->positions,
                   head_pose(unknowns_, activations), pose_derivative(unknowns_), std::move(which));
  if (point->adjoint.size() > 0 && curvature_counts(*point))
    shape.curvature = point->mechanical, shape.target_curvature = point->target;
  return shape;
}

std::shared_ptr<LocalModel> Objective::local(const Vector& activations) {
  auto shape = local_shape(activations);
  if (!shape) return nullptr;
  std::vector<LocalShape> shapes;
  shapes.push_back(std::move(*shape));
  return std::make_unique<LocalProblem>(
      std::move(shapes), QuadraticTerm{prior_.rows.sparseView(), prior_.values}, activations);
}

bool Objective::curvature_counts(const ObjectivePoint& point) const {
  if (promised_gain(point, gauss_newton(point)) > small_gain * point.value) return false;
  return std::isfinite(promised_gain(point, exact_hessian(point)));
}

double Objective::promised_gain(const ObjectivePoint& point, const Matrix& h) const {
  const Vector &z = point.activations, &g = point.gradient;
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < z.size(); ++i)
    if (!(z[i] < prior_.lower[i] + near_bound && g[i] > 0) &&
        !(z[i] > prior_.upper[i] - near_bound && g[i] < 0) && !prior_.fixed(i))
      free.push_back(i);
  if (free.empty()) return 0;
  const Vector slope = g(free);
  const Eigen::LLT<Matrix> factor(Matrix(h(free, free)));
  return factor.info() == Eigen::Success ? 0.5 * slope.dot(factor.solve(slope))
                                         : std::numeric_limits<double>::infinity();
}

void set_optimum(const ObjectivePoint& point, Answer& answer) {
  answer.activations = point.activations;
  answer.shape = point.equilibrium.x;
  answer.shape_by_unknown = point.positions;
  answer.residuals = point.residuals;
  answer.rms = point.residuals.rms;
  answer.max = point.residuals.max;
}

Vector Objective::difference_gradient(const ObjectivePoint& point) {
  constexpr double step = 1e-4;  // of an activation
  const Eigen::Index n = point.activations.size();
  Vector gradient(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    ObjectivePoint beside;
    const double h = point.activations[k] + step > prior_.upper[k] ? -step : step;
    if (!solve(point.activations + h * Vector::Unit(n, k), beside)) return {};
    gradient[k] = (beside.value - point.value) / h;
  }
  return gradient;
}

Matrix Objective::gauss_newton(const ObjectivePoint& point) const {
  return point.jacobian.transpose() * point.jacobian + prior_.hessian();
}

Matrix Objective::exact_hessian(const ObjectivePoint& point) const {
  if (point.mechanical.size() == 0) {
    const Positions& x = point.equilibrium.x;
    point.mechanical =
        mechanical_curvature(model_, unknowns_, point.activations, x, point.equilibrium.parameters,
                             point.positions, point.adjoint, ws_);
    point.target = target_curvature(comparison_, x, head_pose(unknowns_, point.activations),
                                    point.residuals, point.positions, pose_derivative(unknowns_));
  }
  return gauss_newton(point) + point.mechanical + point.target;
}

}  // namespace genio

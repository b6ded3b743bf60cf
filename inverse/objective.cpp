#include "inverse/objective.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "forward/sensitivity.hpp"
#include "inverse/curvature.hpp"

namespace genio {
namespace {

constexpr double near_bound = 2e-3;   // activation
constexpr double large_misfit = 1.5;  // chi-square a residual
constexpr double near_optimum = 1;    // fall of the objective still to be had
constexpr double trial_tolerance = 1e-8;
constexpr double longest_step = 5e-3;  // of any node between two points [m]
constexpr double unbounded = std::numeric_limits<double>::infinity();

/// The optimiser comes back to points that it has rounded.
bool same(const Vector& a, const Vector& b) { return (a - b).cwiseAbs().maxCoeff() < 1e-12; }

}  // namespace

Objective::Objective(const Model& model, const Comparison& comparison, const Prior& prior,
                     const InferOptions& options, Workspace& ws)
    : model_(model),
      comparison_(comparison),
      options_(options),
      ws_(ws),
      commands_(
          unknowns(model, prior, options.bilateral.value_or(comparison.target().midsagittal()))),
      base_(default_parameters(model)),
      prior_(prior_terms(prior, commands_)),
      factorizations_before_(ws.cholesky.factorizations()),
      started_(std::chrono::steady_clock::now()) {}

double Objective::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
}

bool Objective::stopped() {
  if (stop_ != InferStatus::converged) return true;
  if (options_.cancelled && options_.cancelled()) stop_ = InferStatus::cancelled;
  else if (options_.deadline_s > 0 && seconds() > options_.deadline_s)
    stop_ = InferStatus::deadline;
  return stop_ != InferStatus::converged;
}

void Objective::weigh(ObjectivePoint& p) const {
  p.value = 0.5 * p.residuals.values.squaredNorm() + prior_.value(p.activations);
  if (p.positions.size() > 0)
    p.gradient = p.jacobian.transpose() * p.residuals.values + prior_.gradient(p.activations);
}

void Objective::set_prior(const Prior& prior) {
  prior_ = prior_terms(prior, commands_);
  if (have_last_) weigh(last_);
  if (have_anchor_) weigh(anchor_);
}

bool Objective::solve(const Vector& activations, ObjectivePoint& point) {
  if (stopped()) return false;
  point.activations = activations;
  const Parameters p = apply_commands(commands_, activations, base_);
  Positions start = model_.rest;
  SolveOptions solve_options;
  if (have_anchor_ && options_.finite_differences) {
    start = anchor_.equilibrium.x;
  } else if (have_anchor_) {
    // Beyond what its linearisation can foresee a step is refused, which costs nothing; the
    // optimiser comes back with a shorter one.
    const Vector step = anchor_.positions * (activations - anchor_.activations);
    start = anchor_.equilibrium.x + step;
    if (step.cwiseAbs().maxCoeff() > longest_step || !std::isfinite(energy(model_, start, p))) {
      failure_ = "the step is too long to follow";
      return false;
    }
    solve_options.tolerance = trial_tolerance;
    solve_options.max_factorizations = 10;
    solve_options.max_load_steps = 0;
  } else if (have_last_) {
    start = last_.equilibrium.x;
  } else if (options_.start_shape) {
    start = *options_.start_shape;
  }
  ++forward_solves_;
  point.equilibrium = solve_equilibrium(model_, p, start, ws_, solve_options);
  if (!point.equilibrium) {
    failure_ = point.equilibrium.message;
    return false;
  }
  point.residuals = comparison_(point.equilibrium.x, head_pose(commands_, activations));
  point.positions.resize(0, 0);
  weigh(point);
  return true;
}

const ObjectivePoint* Objective::value(const Vector& activations) {
  if (have_last_ && same(last_.activations, activations)) return &last_;
  if (have_anchor_ && same(anchor_.activations, activations)) return &anchor_;
  ObjectivePoint point;
  if (!solve(activations, point)) return nullptr;
  last_ = std::move(point);
  have_last_ = true;
  return &last_;
}

const ObjectivePoint* Objective::derivatives(const Vector& activations) {
  if (have_anchor_ && same(anchor_.activations, activations)) return &anchor_;
  if (!value(activations)) return nullptr;
  ObjectivePoint point = last_;
  if (options_.finite_differences) {
    point.gradient = difference_gradient(point);
    if (point.gradient.size() == 0) return nullptr;
    anchor_ = std::move(point);
    have_anchor_ = true;
    return &anchor_;
  }
  const Matrix pull =
      command_pulls(model_, commands_, point.equilibrium.x, point.equilibrium.parameters);
  point.positions = sensitivity_to_forces(model_, point.equilibrium, pull, ws_);
  if (point.positions.size() == 0) {
    failure_ = "the equilibrium is unstable";
    return nullptr;
  }
  point.adjoint = model_.dofs.expand(ws_.cholesky.solve(model_.dofs.reduce(
      misfit_gradient(point.residuals, point.residuals.values, point.equilibrium.x.size()))));
  point.jacobian = residual_jacobian(point.residuals, point.positions) +
                   point.residuals.pose * pose_derivative(commands_);
  weigh(point);
  anchor_ = std::move(point);
  have_anchor_ = true;
  return &anchor_;
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

double Objective::promised_gain() const {
  if (options_.finite_differences) return unbounded;
  return have_anchor_ ? promised_gain(anchor_, hessian(anchor_)) : unbounded;
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
  return factor.info() == Eigen::Success ? 0.5 * slope.dot(factor.solve(slope)) : unbounded;
}

Matrix Objective::gauss_newton(const ObjectivePoint& point) const {
  return point.jacobian.transpose() * point.jacobian + prior_.hessian();
}

Matrix Objective::exact_hessian(const ObjectivePoint& point) const {
  if (point.curvature.size() == 0)
    point.curvature =
        misfit_curvature(model_, comparison_, commands_, point.activations, point.equilibrium,
                         point.residuals, point.positions, point.adjoint, ws_);
  return gauss_newton(point) + point.curvature;
}

Matrix Objective::hessian(const ObjectivePoint& point) const {
  const Matrix rough = gauss_newton(point);
  // What Gauss-Newton leaves out goes with the residuals; within noise they hardly bend the valley.
  const bool small =
      point.residuals.values.squaredNorm() < large_misfit * double(point.residuals.values.size());
  if (small || promised_gain(point, rough) > near_optimum) return rough;
  const Matrix exact = exact_hessian(point);
  return promised_gain(point, exact) < unbounded ? exact : rough;
}

}  // namespace genio

#pragma once
// The reduced objective: commands in, misfit and its derivatives out, the mechanics hidden inside.

#include <chrono>

#include "inverse/infer.hpp"

namespace genio {

/// Everything known at one point of command space.
struct ObjectivePoint {
  Vector activations;  ///< all unknowns
  Equilibrium equilibrium;
  Residuals residuals;
  double value = 0;
  // Filled on demand:
  Matrix positions;  ///< dx/d activation, 3 n x count
  Matrix jacobian;   ///< d residual / d unknown
  Vector gradient;
  Vector adjoint;            ///< K^-1 of the misfit's derivative with respect to the positions
  mutable Matrix curvature;  ///< misfit_curvature(), once asked for
};

/// Evaluates and remembers. The last point whose sensitivities are known predicts the shape of the
/// next, so that equilibrium is found in a few cheap steps.
class Objective {
 public:
  Objective(const Model& model, const Comparison& comparison, const Prior& prior,
            const InferOptions& options, Workspace& ws);

  /// Changes the prior; what is remembered stays valid but for its value and gradient.
  void set_prior(const Prior& prior);
  const PriorTerms& prior() const { return prior_; }

  const std::vector<Command>& commands() const { return commands_; }
  /// nullptr where no equilibrium was found or the time is up.
  const ObjectivePoint* value(const Vector& activations);
  /// As value(), with gradient and jacobian.
  const ObjectivePoint* derivatives(const Vector& activations);
  /// Gauss-Newton Hessian at a point whose derivatives are known.
  Matrix gauss_newton(const ObjectivePoint& point) const;
  /// The Hessian with the second derivatives of the residuals, which count where the misfit stays
  /// large.
  Matrix exact_hessian(const ObjectivePoint& point) const;
  /// For the optimiser and the posterior: Gauss-Newton far from the optimum, where it is always
  /// positive definite and foresees more; near it exact, as Gauss-Newton zigzags there if the
  /// misfit stays large, unless the commands free to move have negative curvature.
  Matrix hessian(const ObjectivePoint& point) const;

  /// The fall of the objective that its quadratic model still promises within the bounds at
  /// the latest point with derivatives; infinite before there is one.
  double promised_gain() const;
  /// The latest point with derivatives; nullptr before there is one.
  const ObjectivePoint* latest() const { return have_anchor_ ? &anchor_ : nullptr; }

  bool stopped();
  InferStatus stop_reason() const { return stop_; }
  const std::string& last_failure() const { return failure_; }
  int factorizations() const { return ws_.cholesky.factorizations() - factorizations_before_; }
  int forward_solves() const { return forward_solves_; }
  double seconds() const;

 private:
  /// Infinite where `hessian` is indefinite over the commands free to move.
  double promised_gain(const ObjectivePoint& point, const Matrix& hessian) const;
  void weigh(ObjectivePoint& point) const;
  Vector difference_gradient(const ObjectivePoint& point);
  bool solve(const Vector& activations, ObjectivePoint& point);

  const Model& model_;
  const Comparison& comparison_;
  const InferOptions& options_;
  Workspace& ws_;
  std::vector<Command> commands_;
  Parameters base_;
  PriorTerms prior_;
  ObjectivePoint last_, anchor_;  // latest evaluated; latest with derivatives
  bool have_last_ = false, have_anchor_ = false;
  InferStatus stop_ = InferStatus::converged;
  std::string failure_;
  int factorizations_before_, forward_solves_ = 0;
  std::chrono::steady_clock::time_point started_;
};

}  // namespace genio

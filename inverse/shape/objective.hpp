#pragma once
// The reduced objective: commands in, misfit and its derivatives out, the mechanics hidden inside.

#include "inverse/shape/infer.hpp"
#include "inverse/shape/local_problem.hpp"
#include "inverse/shape/work_clock.hpp"
#include "inverse/solver/descent.hpp"
#include "inverse/target/comparison.hpp"

namespace genio {

/// Everything known at one point of command space.
struct ObjectivePoint {
  Vector activations;  ///< all unknowns
  Equilibrium equilibrium;
  Residuals residuals;
  double value = 0;
  // With derivatives:
  Matrix positions;  ///< dx/d activation, 3 n x count
  Matrix jacobian;   ///< d residual / d unknown
  Vector gradient;
  Vector adjoint;  ///< K^-1 of the misfit's derivative with respect to the positions
  mutable Matrix mechanical, target;  ///< parts of the curvature, once asked for
};

/// Puts the point into an answer; forces and verdict are summarise_posterior's.
void set_optimum(const ObjectivePoint& point, Answer& answer);

/// Evaluates and remembers. The last point whose sensitivities are known predicts the shape of the
/// next, so that equilibrium is found in a few cheap steps.
class Objective final : public MisfitProblem {
 public:
  Objective(const Model& model, const Comparison& comparison, const Prior& prior,
            const InferOptions& options, Workspace& ws);

  /// Changes the prior; what is remembered stays valid but for its value and gradient.
  void set_prior(PriorTerms prior);
  const PriorTerms& prior() const { return prior_; }
  const std::vector<Unknown>& unknowns() const { return unknowns_; }

  /// The latest point with derivatives, which is where a descent stands; nullptr: there was none.
  const ObjectivePoint* latest() const { return have_anchor_ ? &anchor_ : nullptr; }
  /// nullptr where no equilibrium was found or the time is up.
  const ObjectivePoint* at(const Vector& activations);
  /// As at(), with the derivatives.
  const ObjectivePoint* derivatives(const Vector& activations);
  Matrix gauss_newton(const ObjectivePoint& point) const;
  /// The Hessian with the second derivatives of the residuals, which count where the misfit stays
  /// large.
  Matrix exact_hessian(const ObjectivePoint& point) const;
  /// By an equilibrium an unknown, to compare with; empty where one is not found.
  Vector difference_gradient(const ObjectivePoint& point);

  /// Its shape near a point, its unknowns numbered from `first` on; empty where there is none.
  std::optional<LocalShape> local_shape(const Vector& activations, int first = 0);

  const Vector& lower() const override { return prior_.lower; }
  const Vector& upper() const override { return prior_.upper; }
  std::optional<double> value(const Vector& activations) override;
  std::shared_ptr<LocalModel> local(const Vector& activations) override;
  bool stopped() override { return clock_.stopped(); }
  const std::string& last_failure() const override { return failure_; }
  double rms() const override { return have_last_ ? last_.residuals.rms : 0; }

  InferStatus stop_reason() const { return clock_.reason(); }
  int factorizations() const { return ws_.cholesky.factorizations() - factorizations_before_; }
  int forward_solves() const { return forward_solves_; }
  double seconds() const { return clock_.seconds(); }

 private:
  void weigh(ObjectivePoint& point) const;
  bool solve(const Vector& activations, ObjectivePoint& point);
  /// The caller's start, taken at its word.
  bool known_start(const Vector& activations, ObjectivePoint& point) const;
  void set_positions(ObjectivePoint& point, Matrix positions) const;
  const ObjectivePoint* keep(ObjectivePoint point);
  /// True where Gauss-Newton foresees no large gain any more, so that what it leaves out matters,
  /// and the exact Hessian bends upwards. Farther away Gauss-Newton foresees more.
  bool curvature_counts(const ObjectivePoint& point) const;
  /// The fall of the quadratic model with this Hessian over the unknowns that no bound presses on;
  /// infinite where it is indefinite.
  double promised_gain(const ObjectivePoint& point, const Matrix& hessian) const;

  const Model& model_;
  const Comparison& comparison_;
  const InferOptions& options_;
  Workspace& ws_;
  std::vector<Unknown> unknowns_;
  Parameters base_;
  PriorTerms prior_;
  ObjectivePoint last_, anchor_;  // latest evaluated; latest with derivatives
  bool have_last_ = false, have_anchor_ = false;
  WorkClock clock_;
  std::string failure_;
  int factorizations_before_, forward_solves_ = 0;
};

}  // namespace genio

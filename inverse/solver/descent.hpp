#pragma once
// Minimising a misfit whose every evaluation is an equilibrium.

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "inverse/solver/local_model.hpp"

namespace genio {

/// What a descent needs of the mechanics. Points are unknowns u within the bounds.
class MisfitProblem {
 public:
  virtual ~MisfitProblem() = default;
  virtual const Vector& lower() const = 0;
  virtual const Vector& upper() const = 0;
  /// The objective; empty where it cannot be evaluated.
  virtual std::optional<double> value(const Vector& u) = 0;
  /// Its local problem at a point whose value is known; null where there is none.
  virtual std::shared_ptr<LocalModel> local(const Vector& u) = 0;
  /// True once the time is up or the requester gave up.
  virtual bool stopped() = 0;
  /// The reason of the latest failure.
  virtual const std::string& last_failure() const = 0;
  /// Root mean square distance at the latest point [m].
  virtual double rms() const = 0;
};

struct DescentOptions {
  int max_iterations = 60;
  double tolerance = 1e-4;  ///< of the fall of the objective still to be had
  std::function<void(int iteration, double rms)> progress = {};
  /// Gives up once even twice what the next step promises would leave the objective above this.
  double hopeless = std::numeric_limits<double>::infinity();
  /// A step that promises less than this and gains less than half of that ends it: kinks of the
  /// objective, where a point's nearest place goes to another facet, are of this size.
  double roughness = 0;
};

struct DescentResult {
  bool converged = false;
  std::string message;  ///< the reason where it did not
  Vector u;             ///< best point; empty where there is none
  double value = 0;
  int iterations = 0;         ///< local problems
  int solver_iterations = 0;  ///< Ipopt's in all of them
};

/// Local problems one after another, each minimised by Ipopt within bounds and a trust region,
/// whose size follows how well they foretold the objective (Conn, Gould & Toint 2000,
/// algorithm 6.1.1). Converged when the next one promises less than the tolerance.
DescentResult descend(MisfitProblem& problem, const Vector& start, const DescentOptions& options);

}  // namespace genio

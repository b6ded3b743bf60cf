#pragma once
// Muscle forces from a measured shape.

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "forward/statics/equilibrium.hpp"
#include "inverse/posterior/estimate.hpp"
#include "inverse/prior/prior.hpp"
#include "inverse/target/comparison.hpp"
#include "inverse/target/target.hpp"

namespace genio {

struct ActingPosterior;
struct Answer;

struct InferOptions {
  std::optional<bool> bilateral;  ///< unset: left and right together for midsagittal targets
  double deadline_s = 0;          ///< 0: none
  int max_iterations = 60;
  double tolerance = 1e-4;               ///< of the fall of the objective still to be had
  ModelError model_error;                ///< widens what the posterior claims
  Vector start;                          ///< activations to start from; empty: rest
  std::optional<Positions> start_shape;  ///< the equilibrium shape near `start`
  /// Its derivative (3 n x unknowns), where an earlier solve left it: then `start_shape` is taken
  /// to be the very equilibrium of `start`, and the first step costs no mechanics.
  Matrix start_by_unknown;
  /// Factorisations that the first equilibrium may take from `start_shape`, without load steps; 0:
  /// whatever it takes.
  int start_factorizations = 0;
  bool rough_start = false;  ///< `start` is only a guess: go near under more effort first
  /// Positions and commands together as unknowns (infer_full_space()); to check the default by.
  bool full_space = false;
  /// Gradient by differences and a quasi-Newton Hessian, to compare with: no posterior.
  bool finite_differences = false;
  std::function<bool()> cancelled;  ///< asked between steps; true ends the work
  std::function<void(int iteration, double rms)> progress;  ///< rms in m
  /// Told of the answer as it is after each step: best fit, shape and distances, no posterior.
  std::function<void(const Answer& so_far)> improved;
};

/// `deadline`, `cancelled`: the work was cut short, and the answer is the best so far. It has no
/// intervals, unless another start had ended before; its shape is empty where no step was done.
enum class InferStatus { converged, deadline, cancelled, failed };

const char* to_string(InferStatus status);

/// Another optimum that fits.
struct Alternative {
  double weight = 0;  ///< posterior probability among the optima found
  std::vector<Estimate> muscles;
  double rms = 0;  ///< [m]
  Positions shape;
};

struct Answer {
  InferStatus status = InferStatus::failed;
  std::string message;  ///< reason of a failure, or of the verdict
  Verdict verdict = Verdict::none;
  std::vector<Estimate> muscles;
  std::vector<Estimate> others;   ///< parameters and head pose estimated along
  std::vector<JointForce> joint;  ///< muscles of which one acts, though each may rest
  /// Probability that left and right are the other way round, where the shape hardly tells.
  std::optional<double> mirrored;
  std::vector<TradeOff> unidentified;  ///< muscles the data cannot tell apart
  double weight = 1;                   ///< of this optimum among those found
  /// Optima whose samples the estimates hold, by their weights; see infer_from_starts.
  int mixed_optima = 1;
  std::shared_ptr<const ActingPosterior> posterior;  ///< what the estimates were made of
  std::vector<Alternative> alternatives;  ///< the others, likeliest first; see infer_from_starts
  double log_evidence = 0;                ///< of the data, by Laplace's method about this optimum
  double rms = 0, max = 0;                ///< distance of the measured points from the shape [m]
  double chi2_per_dof = 0;
  Residuals residuals;
  Vector activations;
  Positions shape;          ///< [m]
  Matrix shape_by_unknown;  ///< its derivative, for the next frame's start
  int iterations = 0, factorizations = 0, forward_solves = 0;
  double wall_s = 0;
};

/// Lets the next descent start where this one ended: the next frame's.
void start_from(const Answer& answer, InferOptions& options);

/// The forces within [0, maximum] that minimise 1/2 sum (distance / sigma)^2 + 1/2 sum
/// (activation / effort_sd)^2, see descend(), and the posterior, see acting_posterior(). Throws
/// InputError for an empty target.
///
/// This is one descent from one start; multi_start.hpp has the search for all that fit.
Answer infer(const Model& model, const Target& target, const Prior& prior, Workspace& ws,
             const InferOptions& options = {});

}  // namespace genio

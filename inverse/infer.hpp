#pragma once
// Muscle forces from a measured shape.

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "forward/equilibrium.hpp"
#include "inverse/commands.hpp"
#include "inverse/target.hpp"

namespace genio {

/// What is believed of the commands before the shape is seen.
struct Prior {
  double effort_sd = 0.2;  ///< standard deviation of the activation about 0
};

struct InferOptions {
  std::optional<bool> bilateral;  ///< unset: left and right together for midsagittal targets
  double deadline_s = 0;          ///< 0: none
  int max_iterations = 60;
  double tolerance = 1e-4;               ///< of the fall of the objective still to be had
  Vector start;                          ///< activations to start from; empty: rest
  std::optional<Positions> start_shape;  ///< the equilibrium shape of `start`
  std::function<bool()> cancelled;       ///< asked between steps; true ends the work
  std::function<void(int iteration, double rms)> progress;  ///< rms in m
};

enum class InferStatus { converged, deadline, cancelled, failed };
enum class Verdict { none, explained, unreachable, mismatch };

const char* to_string(InferStatus status);
const char* to_string(Verdict verdict);

/// One muscle of an answer. Forces in N, both sides together for bilateral commands.
struct CommandEstimate {
  std::string name;
  double force = 0, max_force = 0;
  double sd = 0;             ///< Laplace standard deviation
  double low = 0, high = 0;  ///< 90 % interval; one-sided where the force is at a bound
  bool at_lower = false, at_upper = false;
};

struct Answer {
  InferStatus status = InferStatus::failed;
  std::string message;  ///< reason of a failure, or of the verdict
  Verdict verdict = Verdict::none;
  std::vector<CommandEstimate> commands;
  std::vector<std::vector<std::string>> unidentified;  ///< muscles the data cannot tell apart
  double rms = 0, max = 0;  ///< distance of the measured points from the shape [m]
  double chi2_per_dof = 0;
  Residuals residuals;
  Vector activations;
  Positions shape;  ///< [m]
  int iterations = 0, factorizations = 0, forward_solves = 0;
  double wall_s = 0;
};

/// The forces within [0, maximum] that minimise 1/2 sum (distance / sigma)^2 + 1/2 sum
/// (activation / effort_sd)^2, by Ipopt with the exact gradient and the Gauss-Newton Hessian, and
/// the Laplace posterior about them. Throws InputError for an empty target.
Answer infer(const Model& model, const Target& target, const Prior& prior, Workspace& ws,
             const InferOptions& options = {});

}  // namespace genio

#pragma once
// Find what a model misses: localise, name, add, and show the gap shrink.

#include <functional>

#include "discrepancy/error_model.hpp"
#include "discrepancy/localise.hpp"
#include "discrepancy/selection.hpp"

namespace genio {

enum class Finding { named, ambiguous, none, unknown };
const char* to_string(Finding finding);

/// The gap between data and shapes, root mean square over points [m]: as it is, and what exceeds
/// the noise.
struct Gap {
  double rms = 0, excess = 0;
};

/// An effect that the data call for.
struct NamedEffect {
  std::string effect, where;
  std::vector<SharedEstimate> parameters;  ///< "stiff_region.factor" and so on
  double confidence = 0;                   ///< probability among all accounts tried
};

/// Another account of the same data.
struct Rival {
  std::string effect, where;
  double probability = 0;
  double similarity = 0;  ///< cosine between its signature and the best one's
};

/// One candidate of one round, as scored and, for the best, as refitted.
struct Ranked {
  Candidate candidate;
  Score score;
  bool refitted = false;
  double log_odds = 0;     ///< against nothing, prior odds included
  double probability = 0;  ///< among all
  std::string message;
};

struct Round {
  std::vector<Ranked> candidates;  ///< most likely first
  double nothing = 0;              ///< probability that nothing (more) is missing
  double chi_square = 0, dof = 0;  ///< of the residuals before
  double seconds_scoring = 0;
};

struct Discovery {
  Finding finding = Finding::none;
  std::string message;
  std::vector<NamedEffect> effects;
  std::vector<Rival> alternatives;
  Gap before, after, heldout_before, heldout_after;
  double noise = 0;        ///< [m]
  double fit_tail = 1;     ///< probability of residuals as large as those left, nothing missing
  ModelDescription model;  ///< patched
  std::vector<Round> rounds;
  JointFit first, last;  ///< fits of the fitted conditions before and after
  JointFit heldout_first, heldout_last;
  ResidualMap map_before, map_after;  ///< of the fitted conditions
  HiddenForce hidden;                 ///< that would close the gap of the model as it was
  Positions rest;                     ///< of the model's nodes
  double seconds = 0;
};

struct DiscoverOptions {
  ModelDoubt doubt;
  /// Correct the shapes for the mesh's own error; false where the data are of the same mesh.
  bool correct_mesh = true;
  int refits = 5;        ///< candidates refitted a round
  int most_effects = 3;  ///< rounds
  double certain = 0.9;  ///< probability of one effect that names it
  /// Largest probability of nothing with which a name is given. Small, as errors that go beyond the
  /// first order, and an effort that the speaker does not share, count as evidence too.
  double nothing = 1e-6;
  double fit_level = 1e-3;  ///< of the test that what is left is noise
  std::function<void(const std::string&)> progress;
};

/// Runs the whole workflow. Throws InputError for observations that do not go with the model.
Discovery discover(const ModelDescription& description, const Observations& observations,
                   const DiscoverOptions& options = {});

}  // namespace genio

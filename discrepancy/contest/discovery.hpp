#pragma once
// What a search for a missing effect found.

#include "discrepancy/candidates/score.hpp"
#include "discrepancy/contest/separation.hpp"
#include "discrepancy/errors/error_model.hpp"
#include "discrepancy/where/localise.hpp"
#include "discrepancy/where/shape_lines.hpp"

namespace genio {

enum class DiscoveryVerdict { named, ambiguous, none, unknown };
const char* to_string(DiscoveryVerdict verdict);
/// In words; `p`, `heldout`: probability of residuals as large as those left, nothing missing, in
/// the conditions fitted and in those held out.
std::string message_of(DiscoveryVerdict verdict, double p, double heldout);

/// The gap between data and shapes, root mean square over points [m]: as it is, and what exceeds
/// the noise.
struct Gap {
  double rms = 0, excess = 0;
};

Gap gap_of(const JointFit& fit, double noise);

/// An effect that the data call for.
struct NamedEffect {
  std::string effect, where;
  std::vector<SharedEstimate> parameters;  ///< "stiff_region.factor" and so on
  double confidence = 0;                   ///< probability among all accounts tried
};

/// An estimate whose number says what an effect does only up to a standard deviation of `more`, in
/// the terms of its typical value. What can be on one side of `absent` only is log-normal above.
SharedEstimate widened(SharedEstimate estimate, const FreeNumber& number, double more);

/// The effects found, one after another, with their parameters as fitted and doubted: a unit of an
/// effect does its work only up to a part, as a newton of a muscle does (their course and the
/// tissue about them are not the model's), and a place is found as well as the mesh lets it be.
std::vector<NamedEffect> named(const JointFit& fit, const std::vector<Candidate>& found,
                               const std::vector<double>& confidence,
                               const ErrorModel& error_model);

/// Another account of the same data.
struct AlternativeEffect {
  std::string effect, where;
  double probability = 0;
  double similarity = 0;               ///< cosine between its signature and the best one's
  std::vector<Experiment> apart = {};  ///< postures that would tell it from the best one
};

/// One candidate of one round, as scored and, for the best, as refitted.
struct RankedCandidate {
  Candidate candidate;
  Score score;
  bool refitted = false;
  double log_odds = 0;     ///< against nothing, prior odds included
  double probability = 0;  ///< among all
  std::string message;
  double heldout_gain = 0;  ///< of log evidence, what the held-out conditions add to the odds
};

struct Round {
  std::vector<RankedCandidate> candidates;  ///< most likely first
  double nothing = 0;                       ///< probability that nothing (more) is missing
  double chi_square = 0, dof = 0;           ///< of the residuals before
  double seconds_scoring = 0;
};

/// Accounts that these data cannot tell apart whatever happens, and so never name.
struct ConfoundedSet {
  std::string name, why;
  std::vector<std::string> members;
};

/// Those of a study: the scale of stiffness and forces where no force is known, and candidates
/// whose every trace the unknown forces can make (`first`: the first round's).
std::vector<ConfoundedSet> confounded_sets(const Observations& observations, const Round& first);

struct Discovery {
  DiscoveryVerdict verdict = DiscoveryVerdict::none;
  std::string message;
  std::vector<NamedEffect> effects;
  std::vector<AlternativeEffect> alternatives;
  std::vector<ConfoundedSet> confounded_sets;
  Gap before, after, heldout_before, heldout_after;
  double noise = 0;         ///< [m]
  double fit_tail = 1;      ///< probability of residuals as large as those left, nothing missing
  double heldout_tail = 1;  ///< the same of the conditions held out
  ModelDescription model;   ///< patched
  std::vector<Round> rounds;
  std::vector<ShapeLine> lines_before, lines_after;  ///< fitted conditions, then held-out ones
  ResidualMap map_before, map_after;                 ///< of the fitted conditions
  HiddenForce hidden;  ///< that would close the gap of the model as it was
  double seconds = 0;
};

}  // namespace genio

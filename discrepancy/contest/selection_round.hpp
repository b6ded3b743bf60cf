#pragma once
// One round of model selection: candidates are scored, the best are refitted in full, and these are
// weighed against each other and against the null model. Each step takes values and returns new
// ones.

#include <optional>

#include "discrepancy/contest/discover_options.hpp"
#include "discrepancy/contest/null_model.hpp"
#include "discrepancy/contest/weighing.hpp"

namespace genio {

/// A candidate that was refitted and reaches all conditions.
struct Contender {
  size_t candidate = 0;  ///< index into the round's candidates
  ModelFit model;
};

struct SelectionRound {
  Round round;  ///< the candidates in the order of their scores, and their probabilities
  std::vector<Contender> contenders;
  size_t likeliest = 0;          ///< of the contenders
  NullModel null_model;          ///< as it is after the round, see restarted()
  std::optional<size_t> winner;  ///< of the contenders the one to be added

  const RankedCandidate& candidate_of(size_t contender) const {
    return round.candidates[contenders[contender].candidate];
  }
};

/// Score: every candidate but those `found` before, by Rao's test at the null model's fit.
/// `influences` and `projection`: of the null model's fitted conditions.
SelectionRound scored(const NullModel& null_model, const std::vector<Matrix>& influences,
                      const Projection& projection, const std::vector<Candidate>& found);

/// Choose and refit: those worth it, but for those that a straight line puts far behind.
SelectionRound refitted(SelectionRound round, const DiscoverOptions& options);

/// Settle: where different effects come close, the mesh's error under each of them decides. The
/// best comes first: who is right gains most by it, and leaves fewer close.
SelectionRound with_mesh_errors(SelectionRound round, const std::vector<Candidate>& found,
                                const DiscoverOptions& options);

/// Weigh: the round with the probabilities of its contenders and of nothing, by their log odds.
SelectionRound weighed(SelectionRound round);

/// The round against the null model that starts where the likeliest contender ends.
SelectionRound against_restarted(SelectionRound round, const DiscoverOptions& options);

/// All steps. There is a winner where nothing is less likely than the options ask for.
SelectionRound select_effect(const NullModel& null_model, const std::vector<Matrix>& influences,
                             const Projection& projection, const std::vector<Candidate>& found,
                             const DiscoverOptions& options);

}  // namespace genio

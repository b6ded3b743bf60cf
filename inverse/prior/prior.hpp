#pragma once
// What is believed of the unknowns before the shape is seen: the list of terms.

#include "inverse/prior/terms/cocontraction.hpp"
#include "inverse/prior/terms/effort.hpp"
#include "inverse/prior/terms/emg.hpp"
#include "inverse/prior/terms/fixed_forces.hpp"
#include "inverse/prior/terms/head_pose_prior.hpp"
#include "inverse/prior/terms/parameters.hpp"
#include "inverse/prior/terms/symmetry.hpp"
#include "inverse/prior/terms/walk.hpp"

namespace genio {

/// A value with the fields of all its terms.
template <PriorTerm... Terms>
struct SumOfTerms : Terms... {
  /// Calls act with each term, in the order of the list.
  template <class Act>
  void each(Act&& act) const {
    (act(static_cast<const Terms&>(*this)), ...);
  }
  template <class Act>
  void each(Act&& act) {
    (act(static_cast<Terms&>(*this)), ...);
  }
};

/// Beliefs in the terms people have them in; all of them Gaussian, within the muscles' maxima.
/// Unknowns and rows of the prior come in this order. EMG stands before effort, which speaks of
/// the muscles that are left; any may rest.
struct Prior : SumOfTerms<EmgTerm, EffortTerm, SymmetryTerm, ParametersTerm, HeadPoseTerm,
                          CocontractionTerm, WalkTerm, FixedForcesTerm> {};

/// The unknowns of an inversion under a prior: muscle commands, then the parameters and the head
/// pose that are estimated along. Throws InputError for a name the model has not, naming it.
std::vector<Unknown> unknowns_of(const Model& model, const Prior& prior, bool bilateral);

/// Throws InputError for muscles that are no unknowns, or forces out of bounds.
PriorTerms prior_terms(const Prior& prior, const std::vector<Unknown>& unknowns);

/// Muscles and parameters that the prior names.
std::vector<std::string> names_in_prior(const Prior& prior);

/// The same prior for the right half of a symmetric tongue.
Prior half_prior(Prior prior);

/// The same prior with `times` the standard deviation of effort.
Prior with_effort(Prior prior, double times);

}  // namespace genio

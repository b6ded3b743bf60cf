#pragma once
// A candidate refitted in full.

#include "discrepancy/contest/model_fit.hpp"

namespace genio {

/// The null model with one candidate more, fitted under the null model's errors. All conditions
/// share the candidate's strengths, which start from the score's estimate. A switch stands at its
/// typical strength; where it squeezes the null model's commands into a worse valley, every
/// condition is inverted anew. The fit gives up once minus the log posterior does not come below
/// `give_up_above`. A model that could not be fitted says why in its message.
ModelFit refit(const ModelFit& null_model, const Candidate& candidate, const Score& score,
               const Errors& errors, double give_up_above);

}  // namespace genio

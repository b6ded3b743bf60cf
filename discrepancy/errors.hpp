#pragma once
// The errors of one set of conditions at a fit.

#include "discrepancy/error_model.hpp"
#include "discrepancy/refinement.hpp"

namespace genio {

/// Errors at a fit; the mesh's own are found anew (null: none but what smooth distances are off
/// by).
Errors errors_at(Study& study, const JointFit& fit, Refinement* refinement,
                 const ModelDoubt& doubt);

}  // namespace genio

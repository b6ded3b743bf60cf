#include "discrepancy/errors.hpp"

#include "discrepancy/influence.hpp"

namespace genio {

Errors errors_at(Study& study, const JointFit& fit, Refinement* refinement,
                 const ModelDoubt& doubt) {
  Errors e;
  if (refinement) e.corrections = refinement->corrections(study, fit);
  e.matrix = residual_covariance(study, fit, influences_of(study, fit), e.corrections, doubt);
  e.covariance.compute(e.matrix);
  return e;
}

}  // namespace genio

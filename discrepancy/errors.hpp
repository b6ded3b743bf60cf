#pragma once
// The errors of one set of conditions at a fit.

#include "discrepancy/error_model.hpp"
#include "discrepancy/refinement.hpp"

namespace genio {

/// Residuals of one set of conditions with all that is believed of their errors.
struct Errors {
  Corrections corrections;
  Matrix matrix;  ///< the covariance
  Eigen::LLT<Matrix> covariance;
  std::vector<Matrix> influences;
};

/// Errors at a fit; the mesh's own are found anew (null: none).
Errors errors_at(Study& study, const JointFit& fit, Refinement* refinement,
                 const ModelDoubt& doubt);

}  // namespace genio

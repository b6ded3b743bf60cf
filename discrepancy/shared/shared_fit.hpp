#pragma once
// Parameters that all conditions share, estimated along with the forces of each.

#include "discrepancy/conditions/joint_fit.hpp"
#include "discrepancy/errors/error_model.hpp"

namespace genio {

/// What the conditions together say of the parameters that they share.
struct SharedFit {
  JointFit fit;
  std::vector<ParameterName> names;  ///< of the model's parameters, as SharedPrior has them
  Vector values;                     ///< in their own units
  Matrix covariance;                 ///< of them, Gaussian, the forces and the head marginalised
  double rms_before = 0, rms_after = 0;  ///< of all points, without and with them [m]
};

/// Fits all conditions that are not held out, first with the shared parameters at what is believed
/// of them and then with them free, under the errors that the model may have: turned fibres, what
/// muscles do, the tissue's stiffness. The mesh is taken to be exact. Throws InputError where the
/// model does not reach the conditions.
SharedFit fit_shared(const ModelDescription& description, const Observations& observations,
                     const SharedPrior& shared, const ErrorModel& error_model = {});

}  // namespace genio

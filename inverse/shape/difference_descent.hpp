#pragma once
// The descent that Genio is compared with: Ipopt on the objective itself, its gradient by
// differences.

#include "inverse/shape/objective.hpp"

namespace genio {

/// A gradient takes an equilibrium an unknown; the Hessian is learnt from the gradients. Ends when
/// several iterations gain next to nothing.
DescentResult descend_by_differences(Objective& objective, const Vector& start,
                                     const DescentOptions& options);

}  // namespace genio

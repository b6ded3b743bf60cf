#pragma once
// What a force anywhere in the tongue does to what was measured.

#include "discrepancy/conditions/joint_fit.hpp"

namespace genio {

/// d residuals / d nodal forces of condition k at its fitted shape: rows x 3 n [1/N], through the
/// stiffness factorised there (K^-1 of every residual's gradient). All candidates, the hidden force
/// and the fibres' uncertainty are products with it. Empty where the equilibrium is unstable.
Matrix influence(ConditionSet& set, const JointFit& fit, size_t k);

/// Of all conditions.
std::vector<Matrix> influences_of(ConditionSet& set, const JointFit& fit);

}  // namespace genio

#pragma once
#include <span>

#include "forward/statics/equilibrium.hpp"

namespace genio {

/// dx/dp at an equilibrium for each of the given parameters: 3 n x count [m per unit].
/// K dx/dp_k = dF/dp_k with the tangent factorised at the equilibrium, one back-substitution each.
/// Empty when the tangent is not positive definite there (an unstable equilibrium).
Matrix sensitivity(const Model& model, const Equilibrium& equilibrium,
                   std::span<const int> parameters, Workspace& ws);

/// As above for any combinations of parameters, given by their dF/dp as nodal forces, a column
/// each; without their held_motion().
Matrix sensitivity_to_forces(const Model& model, const Equilibrium& equilibrium,
                             const Matrix& force_derivatives, Workspace& ws);

/// DofMap's expand and reduce of every column.
Matrix expand_columns(const DofMap& dofs, const Matrix& unknowns);
Matrix reduce_columns(const DofMap& dofs, const Matrix& nodal);

}  // namespace genio

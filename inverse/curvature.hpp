#pragma once
// What Gauss-Newton leaves out of the Hessian of the misfit.

#include "forward/equilibrium.hpp"
#include "inverse/commands.hpp"
#include "inverse/target.hpp"

namespace genio {

/// dF/d activation of every command as nodal forces at x: 3 n x count [N].
Matrix command_pulls(const Model& model, const std::vector<Command>& commands, const Positions& x,
                     const Parameters& p);

/// The derivative of the misfit with respect to the nodal positions, sum_k r_k dr_k/dx [1/m].
Vector misfit_gradient(const Residuals& residuals, const Vector& values, Eigen::Index size);

/// sum_k r_k d2 r_k / dz_i dz_j over the unknowns z: the target's own curvature and that of the
/// map from commands to shapes. With X = dx/dz, P = dF/dz and the adjoint K lambda = sum r dr/dx,
///   S_ij = X_j . d/de [ sum_k r_k dr_k/dx - K lambda ] + lambda . d/de P_j,
/// the derivative along x + e X_i, z + e by differences, so that every target, every effect and
/// every parameter counts (head pose likewise). Costs an assembly an unknown and no factorisation;
/// uses ws.stiffness only.
Matrix misfit_curvature(const Model& model, const Comparison& comparison,
                        const std::vector<Command>& commands, const Vector& z,
                        const Equilibrium& equilibrium, const Residuals& residuals,
                        const Matrix& positions, const Vector& adjoint, Workspace& ws);

}  // namespace genio

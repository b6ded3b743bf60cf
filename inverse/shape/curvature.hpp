#pragma once
// What Gauss-Newton leaves out of the Hessian of the misfit.

#include "forward/statics/equilibrium.hpp"
#include "inverse/prior/base/unknowns.hpp"
#include "inverse/target/comparison.hpp"
#include "inverse/target/head_pose.hpp"
#include "inverse/target/target.hpp"

namespace genio {

/// dF/d activation of every command as nodal forces at x: 3 n x count [N].
Matrix force_by_unknown(const Model& model, const std::vector<Unknown>& unknowns,
                        const Positions& x, const Parameters& p);

/// How far every command moves what no unknown can move, see held_motion(): 3 n x count [m].
Matrix held_by_unknown(const Model& model, const std::vector<Unknown>& unknowns,
                       const Parameters& p);

/// adjoint . dP_j/dz_i, P the pulls, while the shape goes along with modes of anatomy; zero, and
/// cheap, where forces are linear in the unknowns.
Matrix pull_changes(const Model& model, const std::vector<Unknown>& unknowns, const Vector& z,
                    const Positions& x, const Parameters& p, const Vector& adjoint);

/// The derivative of the misfit with respect to the nodal positions, sum_k r_k dr_k/dx [1/m].
Vector misfit_gradient(const Residuals& residuals, Eigen::Index size);

/// The target's own curvature, sum_k r_k d2 r_k, over unknowns that move the nodes by `positions`
/// (3 n x count) and the pose by `pose_by_unknown` (3 x count).
Matrix target_curvature(const Comparison& comparison, const Positions& x, const HeadPose& pose,
                        const Residuals& residuals, const Matrix& positions,
                        const Matrix& pose_by_unknown);

/// The curvature that the map from unknowns to shapes adds. With X = dx/dz, P = dF/dz and the
/// adjoint K lambda = sum r dr/dx, differentiating K X = P once more gives
///   lambda . K X_ij = -X_i . (dK) X_j + X_i . (dP_j) + X_j . (dP_i) + lambda . dP_j/dz_i,
/// (dK) and (dP) the derivatives along lambda: the energy's third derivatives are symmetric, so one
/// direction serves all pairs of unknowns. With modes of anatomy, X and P are those of a shape that
/// goes along with their fields. By differences, so that every effect and
/// parameter counts: two assemblies. Overwrites ws.stiffness.
Matrix mechanical_curvature(const Model& model, const std::vector<Unknown>& unknowns,
                            const Vector& z, const Positions& x, const Parameters& p,
                            const Matrix& positions, const Vector& adjoint, Workspace& ws);

}  // namespace genio

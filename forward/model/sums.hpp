#pragma once
// What the terms of a model add up to: energy, forces, stiffness, damping and their derivatives.

#include <functional>
#include <span>

#include "forward/effects/newton_aid.hpp"
#include "forward/geometry/volume_gradients.hpp"
#include "forward/model/model.hpp"

namespace genio {

/// Total potential energy [J]; +infinity for inverted tissue, also in the rest configuration of the
/// anatomy that the parameters have. Everything here is that of the model at_anatomy().
double energy(const Model& model, const Positions& x, const Parameters& p);
/// Total nodal forces [N].
Forces force(const Model& model, const Positions& x, const Parameters& p);
/// Those of the potentials of some of its effects.
Forces forces_of(const Model& model, const Positions& x, const Parameters& p,
                 const std::function<bool(const Effect&)>& which);
/// Norm of the nodal forces of loads and contacts, which a residual is compared with [N]; at least
/// 1 mN.
double load_size(const Model& model, const Positions& x, const Parameters& p);
/// Total stiffness into `k` (overwritten) [N/m].
void stiffness(const Model& model, const Positions& x, const Parameters& p, Stiffness& k);
/// Total stiffness for a Newton step, see NewtonAid::add_step_stiffness.
void step_stiffness(const Model& model, const Positions& x, const LinearStep& led,
                    const Parameters& p, Stiffness& k);
/// The part of the stiffness at x that keeps volumes. It shares the model's batches.
Bulk bulk(const Model& model, const Positions& x, const Parameters& p);
/// Smallest of the potentials' step limits.
double step_limit(const Model& model, const Positions& x, const Positions& along,
                  const Parameters& p);
/// Total nodal forces at the velocities v: those of the potential and, in `viscous`, those of the
/// dissipation [N].
Forces forces_in_motion(const Model& model, const Positions& x, const Vector& v,
                        const Parameters& p, Forces& viscous);
/// Adds the total damping, times `scale`, to `k`; `scratch` is overwritten.
void add_damping(const Model& model, const Positions& x, const Vector& v, const Parameters& p,
                 double scale, Stiffness& scratch, Stiffness& k);
/// The tissue's and the effects' mass [kg]. Throws InputError for a model without.
NodeMatrix mass_matrix(const Model& model, const Parameters& p);
/// dF/dp_k as nodal forces, for each of the given parameters: 3 n x count [N per unit]. Nodes stay
/// where they are, but what no unknown can move goes with a mode of anatomy, see force_by_modes().
Matrix force_derivatives(const Model& model, const Positions& x, const Parameters& p,
                         std::span<const int> parameters);

/// The same of the forces in motion, those of the potential and of the dissipation together.
Matrix motion_force_derivatives(const Model& model, const Positions& x, const Vector& v,
                                const Parameters& p, std::span<const int> parameters);
/// The derivative of the viscous forces along each column of `along`, nodal displacements at fixed
/// v. `scratch` is overwritten.
Matrix viscous_slope(const Model& model, const Positions& x, const Vector& v, const Parameters& p,
                     const Matrix& along, Stiffness& scratch);

/// Deepest penetration of any surface [m].
double max_penetration(const Model& model, const Positions& x, const Parameters& p);

}  // namespace genio

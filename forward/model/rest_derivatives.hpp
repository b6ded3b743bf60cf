#pragma once
// How forces change as the rest configuration moves along modes of anatomy.

#include <span>

#include "forward/model/model.hpp"

namespace genio {

/// dF/dm_k for each of these modes of the model's description, by their numbers, at the shape x and
/// the anatomy of p: 3 n x count [N per standard deviation]. Nodes stay where they are, but what no
/// unknown can move goes with its bone (see held_motion()). The model need not have the effect
/// `anatomy`; its modes are then at 0.
///
/// With the fields U: dF/dm = G + K U', where U' is the part of U that unknowns can follow, K the
/// stiffness, and G what the forces do while the shape moves along with its rest configuration: of
/// contacts in closed form, of all other potentials a central difference of fourth order over
/// potentials that are made anew. Such a motion strains the tissue little, so that G is smooth over
/// a large step.
Matrix force_by_modes(const Model& model, const Positions& x, const Parameters& p,
                      std::span<const int> modes);

/// adjoint . d2F/dm_j dm_k for each pair of these modes while the shape goes along with their
/// fields: count x count. By second differences; of contacts by differences of their closed form.
/// The model has the effect `anatomy`.
Matrix force_by_mode_pairs(const Model& model, const Positions& x, const Parameters& p,
                           std::span<const int> modes, const Vector& adjoint);

}  // namespace genio

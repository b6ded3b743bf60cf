#pragma once
#include <span>

#include "forward/effects/description.hpp"
#include "forward/effects/surroundings/contact_surface.hpp"

namespace genio {

/// Adds how the force of a contact changes while tongue, rest configuration and bone move together
/// along each of some modes (3 n x modes, added to [N per standard deviation]). `rest`: the rest
/// configuration [m]; `of_bone`: the displacements of the surface's vertices.
void add_contact_rates(const ContactSurface& surface, double stiffness, const Positions& x,
                       EffectParameters jaw, const Positions& rest,
                       std::span<const AnatomyMode* const> modes,
                       std::vector<Vec3> AnatomyMode::*of_bone, Matrix& df);

}  // namespace genio

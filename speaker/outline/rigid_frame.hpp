#pragma once
#include "forward/effects/description.hpp"
#include "inverse/recording/registration/registration.hpp"
#include "speaker/outline/outline.hpp"

namespace genio {

/// The side of a palate's midsagittal line that the tongue can touch, from the incisors' lower edge
/// backwards to the lower end of the velum (or of what follows), from any line along it that faces
/// the model; empty where it has no such part.
std::vector<Vec2> underside_of_palate(const std::vector<Vec2>& line);

/// Its part up to the arch's top.
std::vector<Vec2> front_of_palate(const std::vector<Vec2>& line);

/// The rigid motion closest to taking each place to its partner (Procrustes; the scale that they
/// differ by tilts nothing and is left where it is).
Similarity rigid_motion(const std::vector<Vec2>& from, const std::vector<Vec2>& to);

/// How an outline that faces the model lies in the model's frame: a rigid motion (scale 1), as a
/// scale belongs to the anatomy. The front of the palate lies on the model's, matched by parts of
/// its length, where both have one; else the lines of the tongues are laid on one another so.
Similarity rigid_frame(const SpeakerOutline& outline, const ModelDescription& model);

/// The outline moved there.
SpeakerOutline moved_outline(SpeakerOutline outline, const Similarity& to_model);

}  // namespace genio

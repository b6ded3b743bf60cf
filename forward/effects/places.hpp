#pragma once
// Where in a tongue an effect may be that has a place.

#include <random>

#include "forward/effects/kind.hpp"

namespace genio {

/// Patches of tissue along the dorsum and at its sides: anterior, middle, posterior, root, left,
/// right.
std::vector<Place> regions(const ModelDescription& description);

/// Bundles that nature has and many models lack, laid out by the landmarks: the horizontal
/// genioglossus (GGH), chondroglossus of each side, and the transverse bundles of palatoglossus and
/// glossopharyngeus (Takemoto 2001; Standring 2016, chapter 31).
std::vector<Place> muscle_courses(const ModelDescription& description);

/// A random node of the midsagittal line between tip and root [m].
Vec3 drawn_on_dorsum(const ModelDescription& description, std::mt19937& random);

}  // namespace genio

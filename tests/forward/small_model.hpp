#pragma once
#include <string>

#include "forward/effects/modes/moved_rest.hpp"
#include "forward/model/build_model.hpp"

namespace genio::test {

/// A distorted block of 3 x 2 x 2 elements with two muscles, a palate above, gravity: small enough
/// to check every derivative by differences.
ModelDescription small_block();
Model small_model();

/// Two modes of anatomy in closed form: a size about a point, and a depth along x that bends.
std::vector<NamedField> test_modes();

/// The same with every effect there is, at the samples of their kinds.
ModelDescription with_every_effect();

/// The generic tongue as shipped.
std::string generic_model();

/// The 11 muscles of both tongues, both sides together.
inline const std::vector<std::string> muscle_names = {"GGP", "GGM",   "GGA",  "HG", "STY", "SL",
                                                      "IL",  "TRANS", "VERT", "GH", "MH"};

/// Folder of reference data, or empty where it is absent.
std::string reference_folder();

/// Displacements with a fixed seed, of `size` [m], that leave tissue the right side out.
Positions shaken(const Model& model, double size, unsigned seed);

}  // namespace genio::test

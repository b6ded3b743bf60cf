#pragma once
// What a device would measure of a tongue's shape.

#include <array>
#include <random>

#include "forward/model/model.hpp"
#include "inverse/target/target.hpp"

namespace genio::bench {

enum class Measurement {
  curve,   ///< 40 points of the midsagittal line
  slices,  ///< and two coronal contours of 20 points
  surface  ///< 120 points of the upper surface
};

inline constexpr std::array all_measurements = {Measurement::curve, Measurement::slices,
                                                Measurement::surface};
const char* to_string(Measurement what);

/// The shape x [m] of `tongue` with Gaussian noise [m] in every coordinate that counts.
Target measured_shape(const Model& tongue, const Positions& x, Measurement what, double noise,
                      std::mt19937& random);

}  // namespace genio::bench

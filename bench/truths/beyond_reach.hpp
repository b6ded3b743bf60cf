#pragma once
// Shapes that the model cannot make, to see whether its verdict says so.

#include <random>

#include "bench/truths/erring_tongue.hpp"
#include "inverse/shape/infer.hpp"

namespace genio::bench {

enum class Beyond {
  pushed_surface,  ///< a dent or bulge that no muscle makes
  other_anatomy,   ///< a tongue longer, shorter, higher or lower by a tenth
  open_jaw         ///< its jaw opened by some degrees, which the model keeps shut
};

const char* to_string(Beyond kind);

/// A tongue of another anatomy, or with its jaw open. Throws std::invalid_argument for a pushed
/// surface, which no tongue has.
ModelDescription beyond_tongue(const ModelDescription& model, Beyond kind, std::mt19937& random);

/// The target moved across its surface by a smooth field, alike over 10 mm, of which a linear fit
/// about the answer to it leaves `noises` root mean square in units of the noise.
Target pushed(const Target& target, const Answer& answer, double noises, std::mt19937& random);

/// How far the shape is from the model's reach: the root mean square of the best fit's residuals in
/// units of the noise, less the noise's own part.
double noises_off(const Answer& answer);

}  // namespace genio::bench

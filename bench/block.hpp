#pragma once
// The block that other codes were measured on.

#include "forward/model.hpp"

namespace genio::bench {

/// 60 x 40 x 50 mm, Yeoh 192 / 90 Pa, bulk modulus 191 872 Pa (nu = 0.499), bottom z = 0 clamped,
/// a constant body force of 1 N in all, along x, over 0 <= x <= 15 mm. `split` divides each of the
/// 12 x 8 x 10 elements into split^3. Density 1040 kg/m^3, Rayleigh damping alpha 40 1/s, beta 0.03 s.
Model block(int split);

/// Node in the middle of its top face.
int top_centre(int split);

}  // namespace genio::bench

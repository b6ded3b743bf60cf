#pragma once
// The block that other codes were measured on.

#include "bench/problems/calculix.hpp"
#include "forward/model/model.hpp"

namespace genio::bench {

/// 60 x 40 x 50 mm, Yeoh 192 / 90 Pa, bulk modulus 191 872 Pa (nu = 0.499), bottom z = 0 clamped,
/// a constant body force of 1 N in all, along x, on the elements within 0 <= x <= 15 mm. Density
/// 1040 kg/m^3, Rayleigh damping alpha 40 1/s, beta 0.03 s.
Model block(const std::array<int, 3>& cells);
/// Each of 12 x 8 x 10 elements divided into split^3.
Model block(int split);

/// Node in the middle of its top face.
int top_centre(int split);

/// The same problem under `newtons`, static, for CalculiX.
CalculixProblem block_for_calculix(const Model& block, double newtons);

}  // namespace genio::bench

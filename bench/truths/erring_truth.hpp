#pragma once
// Tongues that differ from the model as a speaker does, so that its answers can be told true or
// not.

#include <array>

#include "bench/problems/truth.hpp"

namespace genio::bench {

/// In what the truth differs from the model beside its mesh, which is refined by eight.
enum class ModelFault {
  turned_fibres,  ///< by 5 degrees on average: what the error model was made from
  single_lines,   ///< fibres as wires of the coarse mesh instead of bundles that fill the tissue
  other_shares,   ///< each fibre's share of its muscle's force off by up to 20 %
  other_law       ///< exponential tissue (Fung) of the same initial modulus in place of Yeoh's
};

inline constexpr std::array all_faults = {ModelFault::turned_fibres, ModelFault::single_lines,
                                          ModelFault::other_shares, ModelFault::other_law};
const char* to_string(ModelFault fault);

/// The tongue of that fault, the same on both sides. The seed draws its random parts.
ModelDescription erring_truth(const ModelDescription& model, ModelFault fault, unsigned seed);

}  // namespace genio::bench

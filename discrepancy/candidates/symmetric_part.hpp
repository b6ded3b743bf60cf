#pragma once
#include "discrepancy/candidates/score.hpp"

namespace genio {

/// A description with what breaks its symmetry taken away from the effects of these candidates, so
/// that half a tongue will do: sides get their mean, a strength that pulls to one side its absent
/// value (gravity along y), and an effect of one side alone goes. As it is where that is of no use.
ModelDescription symmetric_part(const ModelDescription& description,
                                const std::vector<Candidate>& effects);

}  // namespace genio

#pragma once
#include "bench/figures/forward/deformation_rows.hpp"
#include "bench/problems/benchmark.hpp"

namespace genio::bench {

/// Writes MUSCLE.svg and MUSCLE.png into the folder: the midsagittal line at rest, by large and by
/// small deformation, at the last level up to 2 N a side and at the largest one that has both.
void draw_muscle(const Model& model, const std::vector<DeformationRow>& rows,
                 const std::string& folder);

/// Writes difference.svg and difference_without_contact.svg, each as a PNG too: the relative
/// difference against the force, a line a muscle.
void draw_differences(const Json& rows, const std::string& folder);

}  // namespace genio::bench

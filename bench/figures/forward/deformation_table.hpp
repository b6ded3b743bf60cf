#pragma once
#include "bench/figures/forward/deformation_rows.hpp"
#include "bench/problems/benchmark.hpp"

namespace genio::bench {

/// The figures of a row; null where a shape that they need was not found. Forces a side [N].
Json deformation_json(const Model& model, const DeformationRow& row);

/// Of the rows of one muscle: from which force the frameworks are 10 % and 1 mm apart, as the model
/// is and without contact, and from which level it touches a bone. A force is 0 where that holds at
/// the first level already and null where it holds at none.
Json deformation_limits(const std::vector<Json>& rows);

/// Both as tables.
std::string deformation_text(const Json& result);

}  // namespace genio::bench

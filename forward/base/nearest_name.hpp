#pragma once
#include <string>
#include <vector>

namespace genio {

/// The candidate with the smallest edit distance to `name` (case does not count); empty when
/// there is no candidate.
std::string nearest_name(const std::string& name, const std::vector<std::string>& candidates);

}  // namespace genio

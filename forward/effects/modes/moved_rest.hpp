#pragma once
// The rest configuration moved along modes of anatomy.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "forward/effects/description.hpp"

namespace genio {

/// A mode as a field in space: where a point of the rest configuration [m] moves for one standard
/// deviation [m].
struct NamedField {
  std::string name;
  std::function<Vec3(const Vec3&)> field;
};

/// The fixed points of all fibres, muscle by muscle and fibre by fibre [m].
std::vector<Vec3> fixed_points(const std::vector<Muscle>& muscles);

/// The description with these modes instead of those that it had, sampled at its nodes, its fixed
/// fibre points and the vertices of its surfaces. The table of the effect `anatomy` lists them at
/// 0. Throws InputError where a name is empty, is there twice or holds more than letters, digits
/// and
/// '_', or a displacement is not finite.
ModelDescription with_modes(ModelDescription description, const std::vector<NamedField>& fields);

/// Throws InputError naming `source` and the mode where a mode does not fit the description: a
/// displacement is missing, or is one too many.
void check_modes(const ModelDescription& description, const std::string& source);

/// Its points moved by sum_k values_k U_k, one value a mode [standard deviations]; the modes and
/// all else stay. Places that effects' tables name, a hinge or the centre of a region, do not move.
ModelDescription moved(ModelDescription description, std::span<const double> values);

}  // namespace genio

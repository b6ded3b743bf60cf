#include "forward/tissue/segment_forces.hpp"

namespace genio {

LengthEnergy unit_tension(const FibreSegment& segment, double length) {
  const double l = segment.short_length;
  if (length >= l) return {length, 1 / length, 0};
  const double s2 = length * length / (l * l);
  return {l * (3.0 / 8 + s2 * (3.0 / 4 - s2 / 8)), (1.5 - 0.5 * s2) / l, 1.5 * (1 - s2) / l};
}

std::vector<std::pair<int, int>> segment_couplings(const std::vector<Muscle>& muscles) {
  std::vector<std::pair<int, int>> pairs;
  for (const auto& m : muscles)
    for (const auto& s : m.segments)
      if (s.start.node >= 0 && s.end.node >= 0) pairs.emplace_back(s.start.node, s.end.node);
  return pairs;
}

std::vector<ParameterName> command_names(const std::vector<Muscle>& muscles) {
  std::vector<ParameterName> names;
  for (const auto& m : muscles) names.push_back({"muscles", m.name});
  return names;
}

}  // namespace genio

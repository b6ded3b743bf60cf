#include "speaker/solid/parts.hpp"

#include "forward/geometry/joined_sets.hpp"

namespace genio {

std::vector<int> part_of_triangles(const TriangleSurface& surface,
                                   const std::vector<TriangleSide>& sides) {
  JoinedSets sets(surface.triangles.size());
  each_edge(sides, [&](auto first, auto last) {
    for (auto s = first + 1; s != last; ++s) sets.join(s->triangle, first->triangle);
  });
  std::vector<int> number(surface.triangles.size(), -1), part(surface.triangles.size());
  int count = 0;
  for (size_t t = 0; t < part.size(); ++t) {
    int& of_set = number[size_t(sets.set(int(t)))];
    if (of_set < 0) of_set = count++;
    part[t] = of_set;
  }
  return part;
}

}  // namespace genio

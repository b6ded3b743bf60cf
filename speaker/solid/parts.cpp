#include "speaker/solid/parts.hpp"

#include <numeric>

namespace genio {

JoinedSets::JoinedSets(size_t count) : above_(count) { std::iota(above_.begin(), above_.end(), 0); }

int JoinedSets::set(int i) {
  while (above_[size_t(i)] != i) {
    above_[size_t(i)] = above_[size_t(above_[size_t(i)])];
    i = above_[size_t(i)];
  }
  return i;
}

void JoinedSets::join(int i, int k) { above_[size_t(set(i))] = set(k); }

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

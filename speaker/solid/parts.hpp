#pragma once
#include <vector>

#include "speaker/solid/edge_list.hpp"

namespace genio {

/// Sets of things that are joined two by two.
class JoinedSets {
 public:
  explicit JoinedSets(size_t count);
  /// The number that stands for the set of thing i.
  int set(int i);
  void join(int i, int k);

 private:
  std::vector<int> above_;
};

/// For each triangle the number of its part, from 0; parts are joined by edges.
std::vector<int> part_of_triangles(const TriangleSurface& surface,
                                   const std::vector<TriangleSide>& sides);

}  // namespace genio

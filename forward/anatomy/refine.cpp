#include "forward/anatomy/refine.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "forward/geometry/hex8.hpp"

namespace genio {

Support support_between(const std::vector<Support>& parents) {
  Support s = parents[0];
  for (Support other : parents) {
    if (other == s) continue;
    if (s == Support::free || other == Support::free) return Support::free;
    s = s == Support::fixed ? other : s;
  }
  return s;
}

std::array<long long, 3> place_cell(const Vec3& x) {
  const auto cell = [](double v) { return std::llround(v * 1e8 + 0.3137); };
  return {cell(x[0]), cell(x[1]), cell(x[2])};
}

RefinedMesh refined(const HexMesh& mesh, const std::vector<Support>& supports) {
  RefinedMesh r{{mesh.nodes, {}}, supports, {}};
  std::map<std::vector<int>, int> between;  // node in the middle of these old ones
  for (const auto& e : mesh.elements) {
    // Node (i, j, k) of 3 x 3 x 3: the mean of the corners on its edge, face or volume.
    std::array<int, 27> grid;
    for (int n = 0; n < 27; ++n) {
      const int at[3] = {n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
      std::vector<int> parents;
      for (size_t a = 0; a < 8; ++a) {
        bool near = true;
        for (int i = 0; i < 3; ++i) near &= at[i] == 0 || at[i] == hex8::corner[a][size_t(i)];
        if (near) parents.push_back(e[a]);
      }
      if (parents.size() == 1) {
        grid[size_t(n)] = parents[0];
        continue;
      }
      std::sort(parents.begin(), parents.end());
      const auto [it, added] = between.emplace(parents, int(r.mesh.nodes.size()));
      if (added) {
        Vec3 x = Vec3::Zero();
        std::vector<Support> kinds;
        for (int a : parents) x += mesh.nodes[size_t(a)], kinds.push_back(supports[size_t(a)]);
        r.mesh.nodes.push_back(x / double(parents.size()));
        r.supports.push_back(support_between(kinds));
      }
      grid[size_t(n)] = it->second;
    }
    for (int c = 0; c < 8; ++c) {
      std::array<int, 8> child;
      for (size_t a = 0; a < 8; ++a) {
        int n = 0;
        for (int i = 2; i >= 0; --i)
          n = 3 * n + (c >> i & 1) + (hex8::corner[a][size_t(i)] + 1) / 2;
        child[a] = grid[size_t(n)];
      }
      r.mesh.elements.push_back(child);
    }
    r.grids.push_back(grid);
  }
  return r;
}

}  // namespace genio

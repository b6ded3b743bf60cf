#include "forward/effects/anatomy.hpp"

namespace genio {

std::vector<int> nodes_with(const Anatomy& a, Support support) {
  std::vector<int> nodes;
  for (size_t n = 0; n < a.supports.size(); ++n)
    if (a.supports[n] == support) nodes.push_back(int(n));
  return nodes;
}

}  // namespace genio

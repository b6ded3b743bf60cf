#pragma once
#include <algorithm>
#include <vector>

namespace genio {

/// At most `count` items spread evenly.
template <class T>
std::vector<T> thin(const std::vector<T>& all, size_t count) {
  std::vector<T> some;
  const double stride = std::max(1.0, double(all.size()) / double(count));
  for (double i = 0; i < double(all.size()); i += stride) some.push_back(all[size_t(i)]);
  return some;
}

}  // namespace genio

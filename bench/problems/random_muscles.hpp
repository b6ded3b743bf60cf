#pragma once
#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

namespace genio::bench {

/// 2 to 5 of `count` muscles, by index.
inline std::vector<int> some_muscles(size_t count, std::mt19937& random,
                                     std::uniform_real_distribution<double>& uniform) {
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), random);
  order.resize(2 + size_t(4 * uniform(random)));
  return order;
}

}  // namespace genio::bench

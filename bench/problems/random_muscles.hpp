#pragma once
#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

namespace genio::bench {

/// `fewest` to `most` of `count` muscles, by index.
inline std::vector<int> some_muscles(size_t count, std::mt19937& random,
                                     std::uniform_real_distribution<double>& uniform,
                                     int fewest = 2, int most = 5) {
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), random);
  order.resize(size_t(fewest) + size_t((most - fewest + 1) * uniform(random)));
  return order;
}

}  // namespace genio::bench

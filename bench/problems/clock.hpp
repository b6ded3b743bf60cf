#pragma once
#include <algorithm>
#include <chrono>
#include <vector>

namespace genio::bench {

/// Wall time of some work [s].
template <class Work>
double seconds(Work work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

inline double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return v[v.size() / 2];
}

template <class Work>
double median_seconds(int times, Work work) {
  std::vector<double> t;
  for (int i = 0; i < times; ++i) t.push_back(seconds(work));
  return median(std::move(t));
}

}  // namespace genio::bench

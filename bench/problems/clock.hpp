#pragma once
#include <algorithm>
#include <vector>

#include "forward/base/elapsed.hpp"

namespace genio::bench {

/// Wall time of some work [s].
template <class Work>
double seconds(Work work) {
  const Stopwatch watch;
  work();
  return watch.seconds();
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

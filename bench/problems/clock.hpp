#pragma once
#include <vector>

#include "forward/base/elapsed.hpp"
#include "forward/base/median.hpp"

namespace genio::bench {

/// Wall time of some work [s].
template <class Work>
double seconds(Work work) {
  const Stopwatch watch;
  work();
  return watch.seconds();
}

using genio::median;

template <class Work>
double median_seconds(int times, Work work) {
  std::vector<double> t;
  for (int i = 0; i < times; ++i) t.push_back(seconds(work));
  return median(std::move(t));
}

}  // namespace genio::bench

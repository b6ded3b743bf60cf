#pragma once
#include <cstddef>
#include <numeric>
#include <vector>

namespace genio {

/// Sets of things that are joined two by two.
class JoinedSets {
 public:
  explicit JoinedSets(size_t count) : above_(count) { std::iota(above_.begin(), above_.end(), 0); }
  /// The number that stands for the set of thing i.
  int set(int i) {
    while (above_[size_t(i)] != i) i = above_[size_t(i)] = above_[size_t(above_[size_t(i)])];
    return i;
  }
  /// The set of k stands for both.
  void join(int i, int k) { above_[size_t(set(i))] = set(k); }

 private:
  std::vector<int> above_;
};

}  // namespace genio

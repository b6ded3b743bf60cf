#pragma once
#include <deque>

#include "forward/base/types.hpp"

namespace genio {

/// BFGS updates of the inverse of a factorised matrix, by the two-loop recursion (Nocedal 1980,
/// Math. Comp. 35; in mechanics Matthies & Strang 1979).
class InverseUpdates {
 public:
  /// H r with H the updated inverse and `solve` the factor's.
  template <class Solve>
  Vector apply(Vector r, Solve solve) const {
    Vector weight(Eigen::Index(pairs_.size()));
    for (size_t i = pairs_.size(); i-- > 0;) {
      weight[Eigen::Index(i)] = pairs_[i].step.dot(r) / pairs_[i].product;
      r -= weight[Eigen::Index(i)] * pairs_[i].change;
    }
    Vector d = solve(r);
    for (size_t i = 0; i < pairs_.size(); ++i)
      d += (weight[Eigen::Index(i)] - pairs_[i].change.dot(d) / pairs_[i].product) * pairs_[i].step;
    return d;
  }
  /// Learns that the force fell by `change` over `step`.
  void learn(const Vector& step, const Vector& change) {
    const double product = step.dot(change);
    if (!(product > 1e-8 * step.norm() * change.norm())) return;
    if (pairs_.size() == most) pairs_.pop_front();
    pairs_.push_back({step, change, product});
  }
  void forget() { pairs_.clear(); }

 private:
  static constexpr size_t most = 8;
  struct Pair {
    Vector step, change;
    double product;
  };
  std::deque<Pair> pairs_;
};

}  // namespace genio

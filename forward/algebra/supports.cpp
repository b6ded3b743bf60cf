#include "forward/algebra/supports.hpp"

namespace genio {

DofMap::DofMap(const std::vector<Support>& supports) : index_(3 * supports.size(), -1) {
  for (size_t a = 0; a < supports.size(); ++a)
    for (int i = 0; i < 3; ++i) {
      const bool partly = supports[a] >= Support::held && !(int(supports[a]) >> i & 1);
      if (supports[a] == Support::free || supports[a] == Support::led || partly)
        index_[3 * a + i] = unknowns_++;
    }
  const std::pair<Support, std::vector<int>> bodies[] = {{Support::horizontal, {0, 1}},
                                                         {Support::body, {0, 1, 2}},
                                                         {Support::forward, {0}},
                                                         {Support::sagittal, {0, 2}}};
  for (const auto& [kind, axes] : bodies) {
    int body = -1;
    for (size_t a = 0; a < supports.size(); ++a) {
      if (supports[a] != kind) continue;
      if (body < 0) body = unknowns_, unknowns_ += int(axes.size());
      for (size_t i = 0; i < axes.size(); ++i) index_[3 * a + size_t(axes[i])] = body + int(i);
    }
  }
}

Vector DofMap::expand(const Vector& unknowns) const {
  Vector nodal = Vector::Zero(Eigen::Index(index_.size()));
  for (size_t i = 0; i < index_.size(); ++i)
    if (index_[i] >= 0) nodal[Eigen::Index(i)] = unknowns[index_[i]];
  return nodal;
}

Vector DofMap::pick(const Vector& nodal) const {
  Vector unknowns = Vector::Zero(unknowns_);
  for (size_t i = 0; i < index_.size(); ++i)
    if (index_[i] >= 0) unknowns[index_[i]] = nodal[Eigen::Index(i)];
  return unknowns;
}

Vector DofMap::reduce(const Vector& nodal) const {
  Vector sum = Vector::Zero(unknowns_);
  for (size_t i = 0; i < index_.size(); ++i)
    if (index_[i] >= 0) sum[index_[i]] += nodal[Eigen::Index(i)];
  return sum;
}

}  // namespace genio

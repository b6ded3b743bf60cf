#include "inverse/prior/base/prior_terms.hpp"

namespace genio {

std::vector<Eigen::Index> PriorTerms::open() const {
  std::vector<Eigen::Index> result;
  for (Eigen::Index i = 0; i < lower.size(); ++i)
    if (!fixed(i)) result.push_back(i);
  return result;
}

}  // namespace genio

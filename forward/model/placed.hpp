#pragma once
#include <memory>
#include <vector>

#include "forward/base/types.hpp"

namespace genio {

/// Values of all parameters of all effects, in the order of Model::parameters.
using Parameters = Eigen::VectorXd;

/// A term of a model and where the parameters that it reads stand in Parameters.
template <class T>
struct Placed {
  std::shared_ptr<const T> term;
  int effect;               ///< index into Model::effects
  std::vector<int> inputs;  ///< its own parameters, then those that it borrows

  const T* operator->() const { return term.get(); }
  /// What it reads.
  std::vector<double> values(const Parameters& p) const {
    std::vector<double> result;
    for (int k : inputs) result.push_back(p[k]);
    return result;
  }
};

}  // namespace genio

#pragma once
// Find what a model misses: localise, name, add, and show the gap shrink.

#include <functional>

#include "discrepancy/contest/discovery.hpp"
#include "discrepancy/errors/error_model.hpp"

namespace genio {

struct DiscoverOptions {
  ErrorModel error_model;
  /// Correct the shapes for the mesh's own error; false where the data are of the same mesh.
  bool correct_mesh = true;
  int refits = 5;        ///< candidates refitted a round
  int most_effects = 3;  ///< rounds
  double certain = 0.9;  ///< probability of one effect that names it
  /// Largest probability of nothing with which a name is given: errors that go beyond the first
  /// order count as evidence too. Set by `genio bench discover`.
  double nothing = 1e-3;
  double fit_level = 0.01;  ///< of the test that what is left is noise
  std::function<void(const std::string&)> progress;
};

/// Runs the whole workflow. Throws InputError for observations that do not go with the model.
Discovery discover(const ModelDescription& description, const Observations& observations,
                   const DiscoverOptions& options = {});

}  // namespace genio
